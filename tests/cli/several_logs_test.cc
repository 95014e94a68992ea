// Logs of one command are read at once; what is told keeps their order.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ident/result/result.h"
#include "support/run_program.h"

namespace ident {
namespace {

const std::string kSample = std::string(IDENT_SOURCE_DIR) + "/data/sample";

ProgramRun flightlog(const std::vector<std::string>& logs, const std::string& folder) {
  std::vector<std::string> arguments = {"flightlog", "--json", "--vehicle", kSample + "/falcon.yaml"};
  arguments.insert(arguments.end(), logs.begin(), logs.end());
  return run_ident(arguments, folder);
}

TEST(SeveralLogs, OfThoseThatAreWrongTheFirstIsTold) {
  const std::string folder = test_folder();
  // The second one fails at once, the first after many rows.
  std::string rows = "t,delta1,delta2,delta3,delta4,p,q,r\n";
  for (int i = 0; i < 20000; ++i) rows += std::to_string(0.01 * i) + ",0.5,0.5,0.5,0.5,0,0,0\n";
  const std::string late = write_text(folder, "late.csv", rows + "200.0,0.5,0.5,x,0.5,0,0,0\n"),
                    early = write_text(folder, "early.csv", "t,delta1\n0,x\n");
  for (int again = 0; again < 5; ++again) {
    const ProgramRun run = flightlog({late, early, kSample + "/flight_eight.csv"}, folder);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("late.csv:20002: delta3: 'x' is not a number"), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("early.csv"), std::string::npos) << run.err;
  }
}

TEST(SeveralLogs, InputsKeepTheOrderOfTheCommand) {
  const std::string folder = test_folder();
  const std::vector<std::string> logs = {kSample + "/flight_mixed.csv", kSample + "/flight_eight.csv"};
  const ProgramRun run = flightlog(logs, folder);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["inputs"], nlohmann::json(logs));
}

}  // namespace
}  // namespace ident
