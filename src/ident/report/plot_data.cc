// Packs time series for the page's script.
#include "ident/report/plot_data.h"

#include <bit>
#include <cstring>

#include "ident/report/channel_colour.h"
#include "ident/report/escape.h"
#include "ident/report/plot_frame.h"

namespace ident {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian floats");

const char* name_of(Series::Style style) {
  switch (style) {
    case Series::Style::points:
      return "points";
    case Series::Style::bars:
      return "bars";
    case Series::Style::measured:
      return "measured";
    case Series::Style::predicted:
      return "predicted";
    case Series::Style::band:
      return "band";
    case Series::Style::line:
      break;
  }
  return "line";
}

double first_finite(const Plot& plot) {
  for (const Series& s : plot.series)
    for (const double x : s.x)
      if (std::isfinite(x)) return x;
  return 0;
}

}  // namespace

std::string base64(const std::string& bytes) {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = (group << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (unsigned k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : kAlphabet[(group >> (18 - 6 * k)) & 63U];
  }
  return out;
}

std::size_t PlotData::store(const std::vector<double>& values, double origin) {
  std::string bytes(values.size() * sizeof(float), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = static_cast<float>(values[i] - origin);
    std::memcpy(bytes.data() + i * sizeof(float), &value, sizeof(float));
  }
  const auto [at, is_new] = known_.try_emplace(base64(bytes), arrays_.size());
  if (is_new) arrays_.push_back(at->first);
  return at->second;
}

int PlotData::add(const Plot& plot, const std::string& group) {
  const std::vector<int> colours = channel_colours(plot.series);
  const double origin = first_finite(plot);
  nlohmann::ordered_json series = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    nlohmann::ordered_json entry{
        {"name", valid_utf8(s.name)}, {"style", name_of(s.style)}, {"colour", colours[i]}};
    entry["x"] = store(s.x, origin);
    entry["y"] = store(s.y, 0);
    if (s.style == Series::Style::band) entry["y2"] = store(s.y2, 0);
    series.push_back(std::move(entry));
  }
  plots_.push_back({{"group", group},
                    {"x", valid_utf8(pretty_unit(plot.x_label))},
                    {"y", valid_utf8(pretty_unit(plot.y_label))},
                    {"origin", origin},
                    {"series", series}});
  return static_cast<int>(plots_.size()) - 1;
}

std::string PlotData::json() const {
  const std::string text = nlohmann::ordered_json{{"arrays", arrays_}, {"plots", plots_}}.dump();
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

}  // namespace ident
