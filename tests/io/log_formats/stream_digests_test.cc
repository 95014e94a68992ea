// Readers of logs against what independent decoders read of the same files. Skipped where these are not at
// hand.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "ident/io/log_formats/read_log_streams.h"
#include "ident/views/streams_digest.h"
#include "support/log_samples.h"

namespace ident {
namespace {

using Json = nlohmann::json;

/// Sums were added up in double precision, in another order: half a rounding error for each of 1e6 values.
constexpr double kRounding = 1e-10;

bool same(const Json& expected, const Json& found, double tolerance) {
  if (expected.is_null() || found.is_null()) return expected.is_null() && found.is_null();
  const double a = expected.get<double>(), b = found.get<double>();
  return std::abs(a - b) <= tolerance * std::max({std::abs(a), std::abs(b)});
}

/// A sum may be small beside its terms: the tolerance is that of as many terms of the size of the ends.
bool same_sum(const Json& expected, const Json& found) {
  const double size = std::max(std::abs(expected.value("first", 0.0)), std::abs(expected.value("last", 0.0)));
  const double slack = kRounding * (expected["n"].get<double>() * size + 1.0);
  return same(expected["sum"], found["sum"], kRounding) ||
         std::abs(expected["sum"].get<double>() - found["sum"].get<double>()) <= slack;
}

std::string differences(const Json& expected, const Json& found) {
  std::string text;
  for (const auto& [stream, fields] : expected.items()) {
    if (!found.contains(stream)) text += stream + " is missing\n";
    if (!found.contains(stream)) continue;
    for (const auto& [field, digest] : fields.items()) {
      const std::string name = stream + " " + field + ": ";
      if (!found[stream]["fields"].contains(field)) {
        text += name + "is missing\n";
        continue;
      }
      const Json& ours = found[stream]["fields"][field];
      Json ends = digest;  // `value` does not take null
      for (const char* end : {"first", "last"})
        if (ends[end].is_null()) ends[end] = 0.0;
      if (digest["n"] != ours["n"] || !same(digest["first"], ours["first"], 1e-15) ||
          !same(digest["last"], ours["last"], 1e-15) || !same_sum(ends, ours))
        text += name + digest.dump() + " expected, " + ours.dump() + " found\n";
    }
  }
  return text;
}

class StreamDigests : public ::testing::TestWithParam<std::string> {};

TEST_P(StreamDigests, AreThoseOfAnIndependentDecoder) {
  IDENT_NEEDS_LOG_SAMPLE(path, GetParam());
  const Json expected = Json::parse(std::ifstream(path + ".json"));
  const LogStreams log = read_log_streams(path);
  EXPECT_EQ(differences(expected["streams"], Json(streams_digest(log))), "");
  if (expected.contains("parameters")) {
    EXPECT_EQ(log.parameters.size(), expected["parameters"].get<std::size_t>());
  }
  EXPECT_TRUE(log.damage.empty()) << log.damage.front();
}

INSTANTIATE_TEST_SUITE_P(OfSamples, StreamDigests,
                         ::testing::Values("ulog/mcap__test_ulog.ulg", "ulog/pyulog__sample_log_small.ulg",
                                           "ulog/pyulog__sample_logging_tagged_and_default_params.ulg",
                                           "ulog/pyulog__sample_px4_events.ulg",
                                           "dataflash/pymavlink__test.BIN", "crazyflie/arplab__log16.usd",
                                           "crazyflie/imrclab__log178"),
                         [](const auto& sample) {
                           std::string name = sample.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace ident
