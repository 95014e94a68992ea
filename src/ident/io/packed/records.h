// Records of one layout that lie scattered in a file, turned into columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ident/data/log_streams.h"

namespace ident {

enum class PackedType { i8, u8, i16, u16, i32, u32, i64, u64, f16, f32, f64 };

std::size_t size_of(PackedType type);

/// A number in each record, `offset` bytes from the record's begin.
struct PackedField {
  std::string name;
  PackedType type = PackedType::u8;
  std::size_t offset = 0;
  std::string unit;
  double scale = 1.0;
};

/// Columns of the records that begin at these bytes. The caller has checked that all records are whole.
std::vector<StreamField> unpack(std::string_view bytes, const std::vector<std::uint64_t>& begins,
                                const std::vector<PackedField>& fields);

/// Makes `t` of a stream from a field that counts `unit` seconds, less `start` of these counts.
void set_clock(LogStream& stream, std::string_view field, std::uint64_t start, double unit);

}  // namespace ident
