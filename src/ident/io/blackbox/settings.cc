// Settings of a blackbox header as parameters and facts of a log.
#include "ident/io/blackbox/settings.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <optional>

namespace ident::blackbox {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> whole_number(std::string_view text) {
  text = trimmed(text);
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The numbers of `158,2047`; empty where one part is none.
std::vector<double> numbers(std::string_view list) {
  std::vector<double> values;
  while (true) {
    const std::size_t comma = list.find(',');
    const std::optional<double> value = whole_number(list.substr(0, comma));
    if (!value) return {};
    values.push_back(*value);
    if (comma == std::string_view::npos) return values;
    list.remove_prefix(comma + 1);
  }
}

std::optional<double> float_of_bits(std::string_view text) {
  if (!text.starts_with("0x")) return std::nullopt;
  std::uint32_t bits = 0;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), bits, 16);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return static_cast<double>(std::bit_cast<float>(bits));
}

class Settings {
 public:
  Settings(int number, LogStreams& streams)
      : prefix_(number == 1 ? std::string{} : fmt::format("{}:", number)), streams_(streams) {}

  void parameter(const std::string& name, double value) {
    if (const auto first = streams_.parameters.find(name);
        !prefix_.empty() && first != streams_.parameters.end() && first->second == value)
      return;
    streams_.parameters.insert_or_assign(prefix_ + name, value);
  }
  void fact(const std::string& name, std::string_view value) {
    if (const auto first = streams_.facts.find(name);
        !prefix_.empty() && first != streams_.facts.end() && first->second == value)
      return;
    streams_.facts.insert_or_assign(prefix_ + name, std::string(value));
  }

 private:
  std::string prefix_;
  LogStreams& streams_;
};

}  // namespace

void add_settings(const Header& header, int number, LogStreams& streams) {
  Settings settings(number, streams);
  for (const auto& [name, value] : header.lines) {
    if (name.starts_with("Field ")) continue;
    if (const auto scale =
            name == "gyro_scale" || name == "gyro.scale" ? float_of_bits(value) : std::nullopt) {
      settings.parameter("gyro_scale", *scale);
      continue;
    }
    const std::vector<double> values = numbers(value);
    if (values.size() == 1) {
      settings.parameter(name, values[0]);
    } else if (values.size() > 1) {
      for (std::size_t i = 0; i < values.size(); ++i)
        settings.parameter(fmt::format("{}[{}]", name, i), values[i]);
    } else {
      settings.fact(name, value);
    }
  }
}

}  // namespace ident::blackbox
