// Letters of formats, and layouts made of them.
#include "ident/io/dataflash/layout.h"

#include <algorithm>
#include <array>

namespace ident::dataflash {
namespace {

constexpr std::size_t kHeader = 3;  // bytes: A3 95, kind of message
constexpr double kHundredth = 0.01, kLatitude = 1e-7;

struct Letter {
  char letter;
  PackedType type;
  double scale = 1.0;
};
constexpr std::array<Letter, 17> kNumbers = {{{'b', PackedType::i8},
                                              {'B', PackedType::u8},
                                              {'M', PackedType::u8},
                                              {'h', PackedType::i16},
                                              {'H', PackedType::u16},
                                              {'i', PackedType::i32},
                                              {'I', PackedType::u32},
                                              {'q', PackedType::i64},
                                              {'Q', PackedType::u64},
                                              {'f', PackedType::f32},
                                              {'d', PackedType::f64},
                                              {'g', PackedType::f16},
                                              {'c', PackedType::i16, kHundredth},
                                              {'C', PackedType::u16, kHundredth},
                                              {'e', PackedType::i32, kHundredth},
                                              {'E', PackedType::u32, kHundredth},
                                              {'L', PackedType::i32, kLatitude}}};

/// Bytes of what is no number; 0: not known either.
std::size_t text_size(char letter) {
  switch (letter) {
    case 'n':
      return 4;
    case 'N':
      return 16;
    case 'Z':
    case 'a':
      return 64;  // 32 numbers of raw sensor samples
    default:
      return 0;
  }
}

std::vector<std::string> split(std::string_view columns) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= columns.size() && !columns.empty();) {
    const std::size_t end = std::min(columns.find(',', at), columns.size());
    names.emplace_back(columns.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

}  // namespace

const TextColumn* Layout::text(std::string_view column) const {
  const auto at = std::ranges::find(texts, column, &TextColumn::name);
  return at == texts.end() ? nullptr : &*at;
}

const PackedField* Layout::field(std::string_view column) const {
  const auto at = std::ranges::find(fields, column, &PackedField::name);
  return at == fields.end() ? nullptr : &*at;
}

std::optional<Layout> make_layout(std::string_view name, std::string_view letters, std::string_view columns,
                                  std::size_t length) {
  Layout layout{.name = std::string(name), .length = kHeader};
  const std::vector<std::string> names = split(columns);
  if (names.size() != letters.size()) return std::nullopt;
  layout.columns = names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto number = std::ranges::find(kNumbers, letters[i], &Letter::letter);
    if (number != kNumbers.end()) {
      layout.fields.push_back(
          {.name = names[i], .type = number->type, .offset = layout.length, .scale = number->scale});
      layout.place.push_back(i);
      layout.length += size_of(number->type);
      continue;
    }
    const std::size_t size = text_size(letters[i]);
    if (size == 0) return std::nullopt;
    if (letters[i] != 'a') layout.texts.push_back({names[i], layout.length, size});
    layout.length += size;
  }
  if (length != 0 && layout.length != length) return std::nullopt;
  return layout;
}

std::string_view fixed_text(std::string_view bytes) { return bytes.substr(0, bytes.find('\0')); }

Clock clock_of(const Layout& layout) {
  if (layout.field("TimeUS")) return {"TimeUS", 1e-6};
  // Before 3.3 a GPS message held the time of the week as TimeMS and that of the autopilot as T.
  if (layout.name.starts_with("GPS") && layout.field("T")) return {"T", 1e-3};
  if (layout.field("TimeMS")) return {"TimeMS", 1e-3};
  return {};
}

}  // namespace ident::dataflash
