// The order in which a parameter report is read.
#include <gtest/gtest.h>

#include "ident/report/html.h"
#include "ident/report/markdown.h"
#include "ident/report/report.h"

namespace ident {
namespace {

TEST(ReportOrder, CorrelationStandsBeforeProfilesAndHeldOutFlight) {
  Result result;
  result.command = "flightlog";
  result.sections = {{.title = "Fit to the log"},
                     {.title = "Profile likelihood of weak parameters"},
                     {.title = "Held-out prediction"}};
  result.correlation = {{"kT", "km"}, Eigen::MatrixXd::Identity(2, 2)};
  for (const std::string& page : {render_html(result), render_markdown(result)}) {
    // The last of each: a page names its headings in its contents first.
    const auto fit = page.rfind("Fit to the log"), correlation = page.rfind("Correlation"),
               profile = page.rfind("Profile likelihood"), held_out = page.rfind("Held-out prediction");
    EXPECT_LT(fit, correlation);
    EXPECT_LT(correlation, profile);
    EXPECT_LT(profile, held_out);
  }
}

}  // namespace
}  // namespace ident
