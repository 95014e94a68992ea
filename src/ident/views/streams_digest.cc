// Sums up streams.
#include "ident/views/streams_digest.h"

#include <algorithm>
#include <cmath>

#include "ident/result/result.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Exact for integers; time stamps of microseconds since 1970 add up to more than a double tells apart.
double sum_of_finite(const StreamField& field) {
  const long double sum = std::visit(
      [](const auto& values) {
        long double total = 0;
        for (const auto value : values)
          if (std::isfinite(static_cast<double>(value))) total += static_cast<long double>(value);
        return total;
      },
      field.values);
  return static_cast<double>(sum * static_cast<long double>(field.scale));
}

Json field_digest(const StreamField& field) {
  Json digest = {{"n", field.size()}};
  if (field.size() == 0) return digest;
  digest["first"] = number(field.at(0));
  digest["last"] = number(field.at(field.size() - 1));
  digest["sum"] = number(sum_of_finite(field));
  return digest;
}

}  // namespace

nlohmann::ordered_json streams_digest(const LogStreams& log) {
  Json all = Json::object();
  for (const LogStream& stream : log.streams) {
    std::size_t samples = stream.t.size();
    for (const StreamField& field : stream.fields) samples = std::max(samples, field.size());
    Json& one = all[stream.name];
    one["samples"] = samples;
    const double span = stream.t.size() < 2 ? 0.0 : stream.t.back() - stream.t.front();
    one["rate_hz"] = span > 0 ? number(static_cast<double>(stream.t.size() - 1) / span) : Json(nullptr);
    one["fields"] = Json::object();
    for (const StreamField& field : stream.fields) one["fields"][field.name] = field_digest(field);
  }
  return all;
}

}  // namespace ident
