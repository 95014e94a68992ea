// The text header of a blackbox log: the fields of each kind of frame, and the settings that decoding needs.
#include "ident/io/blackbox/header.h"

#include <algorithm>
#include <charconv>

#include "ident/io/blackbox/frame_decoder.h"

namespace ident::blackbox {

namespace {

/// Leading integer of a text, 0 without one, as `atoi` gives it.
int leading_integer(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

template <typename Use>
void for_each_item(std::string_view list, Use use) {
  while (!list.empty()) {
    // An empty name is taken for the start of the next, as blackbox_decode does.
    const std::size_t comma = list.find(',', 1);
    use(list.substr(0, comma));
    if (comma == std::string_view::npos) break;
    list.remove_prefix(comma + 1);
  }
}

void read_integers(std::string_view list, std::array<int, max_fields>& into) {
  std::size_t i = 0;
  for_each_item(list, [&](std::string_view item) {
    if (i < into.size()) into[i++] = leading_integer(item);
  });
}

FrameDefinition* definition_of(Header& header, char kind) {
  switch (kind) {
    case 'I':
      return &header.I;
    case 'P':
      return &header.P;
    case 'S':
      return &header.S;
    case 'G':
      return &header.G;
    case 'H':
      return &header.H;
    default:
      return nullptr;
  }
}

/// `Field I name:...`, `signed`, `predictor`, `encoding`. P frames share names and signs of I frames.
void read_field_line(Header& header, std::string_view name, std::string_view value) {
  FrameDefinition* definition = definition_of(header, name.size() > 6 ? name[6] : ' ');
  if (!definition) return;
  if (name.ends_with(" name")) {
    definition->names.clear();
    for_each_item(value, [&](std::string_view item) { definition->names.emplace_back(item); });
    if (definition == &header.I) header.P.names = header.I.names;
  } else if (name.ends_with(" signed")) {
    read_integers(value, definition->is_signed);
    if (definition == &header.I) header.P.is_signed = header.I.is_signed;
  } else if (name.ends_with(" predictor")) {
    read_integers(value, definition->predictor);
  } else if (name.ends_with(" encoding")) {
    read_integers(value, definition->encoding);
  }
}

void read_line(Header& header, std::string_view name, std::string_view value) {
  if (name.starts_with("Field ")) {
    read_field_line(header, name, value);
  } else if (name == "I interval") {
    header.interval_I = std::max(1, leading_integer(value));
  } else if (name == "P interval") {
    const std::size_t slash = value.find('/');
    if (slash == std::string_view::npos) return;
    header.interval_P_numerator = leading_integer(value);
    header.interval_P_denominator = leading_integer(value.substr(slash + 1));
  } else if (name == "Data version") {
    header.data_version = leading_integer(value);
  } else if (name == "minthrottle") {
    header.min_throttle = header.motor_low = leading_integer(value);
  } else if (name == "motorOutput") {
    header.motor_low = leading_integer(value);
  } else if (name == "vbatref") {
    header.vbat_reference = leading_integer(value) & 0xffff;
  }
}

/// Position after the header line that begins at `at` (its `H`), which is stored if it is whole.
std::size_t take_line(Header& header, std::span<const std::uint8_t> log, std::size_t at) {
  if (at + 1 >= log.size() || log[at + 1] != ' ') return at + 2;
  const std::size_t begin = at + 2;
  std::size_t end = begin;
  while (end < log.size() && log[end] != '\n' && log[end] != '\0' && log[end] != 0xff) ++end;
  if (end == log.size() || log[end] != '\n') return std::min(end + 1, log.size());
  std::string_view line(reinterpret_cast<const char*>(log.data()) + begin, end - begin);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  const std::size_t colon = line.find(':');
  if (colon != std::string_view::npos) {
    header.lines.emplace_back(line.substr(0, colon), line.substr(colon + 1));
    read_line(header, line.substr(0, colon), line.substr(colon + 1));
  }
  return end + 1;
}

}  // namespace

int FrameDefinition::find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

std::string_view Header::value(std::string_view name) const {
  for (const auto& [key, text] : lines)
    if (key == name) return text;
  return {};
}

Header read_header(std::span<const std::uint8_t> log) {
  Header header;
  std::size_t at = 0;
  while (at < log.size()) {
    const std::uint8_t c = log[at];
    if (c == 0xff) break;
    if (c == 'H') {
      at = take_line(header, log, at);
    } else if (is_frame_kind(c)) {
      header.reaches_data = true;
      break;
    } else {
      ++at;
    }
  }
  header.data_begin = at;
  return header;
}

}  // namespace ident::blackbox
