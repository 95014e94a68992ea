// Unpacks records block by block, so that each record is fetched from memory once.
#include "ident/io/packed/records.h"

#include <algorithm>
#include <type_traits>

#include "ident/io/packed/little_endian.h"

namespace ident {
namespace {

constexpr std::size_t kBlock = 256;  // records; their bytes stay in the first caches

template <class Number>
void unpack_block(std::string_view bytes, const std::uint64_t* begins, std::size_t count, std::size_t offset,
                  std::vector<Number>& to, std::size_t first) {
  for (std::size_t i = 0; i < count; ++i) to[first + i] = load<Number>(bytes.data() + begins[i] + offset);
}

void unpack_halves(std::string_view bytes, const std::uint64_t* begins, std::size_t count, std::size_t offset,
                   std::vector<float>& to, std::size_t first) {
  for (std::size_t i = 0; i < count; ++i)
    to[first + i] = half_to_float(load<std::uint16_t>(bytes.data() + begins[i] + offset));
}

StoredValues room_for(PackedType type, std::size_t rows) {
  switch (type) {
    case PackedType::i8:
      return std::vector<std::int8_t>(rows);
    case PackedType::u8:
      return std::vector<std::uint8_t>(rows);
    case PackedType::i16:
      return std::vector<std::int16_t>(rows);
    case PackedType::u16:
      return std::vector<std::uint16_t>(rows);
    case PackedType::i32:
      return std::vector<std::int32_t>(rows);
    case PackedType::u32:
      return std::vector<std::uint32_t>(rows);
    case PackedType::i64:
      return std::vector<std::int64_t>(rows);
    case PackedType::u64:
      return std::vector<std::uint64_t>(rows);
    case PackedType::f16:
    case PackedType::f32:
      return std::vector<float>(rows);
    case PackedType::f64:
      break;
  }
  return std::vector<double>(rows);
}

}  // namespace

std::size_t size_of(PackedType type) {
  switch (type) {
    case PackedType::i8:
    case PackedType::u8:
      return 1;
    case PackedType::i16:
    case PackedType::u16:
    case PackedType::f16:
      return 2;
    case PackedType::i32:
    case PackedType::u32:
    case PackedType::f32:
      return 4;
    case PackedType::i64:
    case PackedType::u64:
    case PackedType::f64:
      break;
  }
  return 8;
}

std::vector<StreamField> unpack(std::string_view bytes, const std::vector<std::uint64_t>& begins,
                                const std::vector<PackedField>& fields) {
  std::vector<StreamField> columns;
  columns.reserve(fields.size());
  for (const PackedField& field : fields)
    columns.push_back({field.name, field.unit, field.scale, room_for(field.type, begins.size())});
  for (std::size_t first = 0; first < begins.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, begins.size() - first);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const PackedField& field = fields[k];
      if (field.type == PackedType::f16)
        unpack_halves(bytes, &begins[first], count, field.offset,
                      std::get<std::vector<float>>(columns[k].values), first);
      else
        std::visit(
            [&](auto& values) { unpack_block(bytes, &begins[first], count, field.offset, values, first); },
            columns[k].values);
    }
  }
  return columns;
}

void set_clock(LogStream& stream, std::string_view field, std::uint64_t start, double unit) {
  const StreamField* counts = stream.find(field);
  if (!counts) return;
  stream.clock = field;
  stream.t.resize(counts->size());
  std::visit(
      [&](const auto& values) {
        using Count = typename std::decay_t<decltype(values)>::value_type;
        for (std::size_t i = 0; i < values.size(); ++i)
          if constexpr (std::is_integral_v<Count>) {
            // The difference of two counts is exact; that of two times of day in seconds would not be.
            const auto count = static_cast<std::int64_t>(static_cast<std::uint64_t>(values[i]) - start);
            stream.t[i] = static_cast<double>(count) * unit;
          } else {
            stream.t[i] = (static_cast<double>(values[i]) - static_cast<double>(start)) * unit;
          }
      },
      counts->values);
}

}  // namespace ident
