// Rows of integers in, typed columns out, with little more memory than the columns take.
#include "ident/io/blackbox/column_store.h"

#include <utility>
#include <variant>

namespace ident::blackbox {

namespace {

// A block of 50 columns then is 100 kB: it stays in the cache. Short logs begin with less.
constexpr std::size_t most_rows_of_block = 256;

StoredValues empty_values(Stored stored) {
  switch (stored) {
    case Stored::int32:
      return std::vector<std::int32_t>{};
    case Stored::uint32:
      return std::vector<std::uint32_t>{};
    case Stored::int64:
      return std::vector<std::int64_t>{};
  }
  return {};
}

}  // namespace

ColumnStore::ColumnStore(std::vector<ColumnKind> columns) {
  fields_.reserve(columns.size());
  for (ColumnKind& kind : columns)
    fields_.push_back({std::move(kind.name), std::move(kind.unit), kind.scale, empty_values(kind.stored)});
  block_.resize(rows_of_block_ * fields_.size());
}

std::span<std::int64_t> ColumnStore::next_row() {
  if (in_block_ == rows_of_block_ && rows_of_block_ < most_rows_of_block) {
    rows_of_block_ *= 2;
    block_.resize(rows_of_block_ * fields_.size());
  } else if (in_block_ == rows_of_block_) {
    flush();
  }
  return std::span(block_).subspan(fields_.size() * in_block_++, fields_.size());
}

void ColumnStore::flush() {
  const std::size_t width = fields_.size();
  for (std::size_t column = 0; column < width; ++column)
    std::visit(
        [&](auto& values) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          const std::size_t begin = values.size();
          values.resize(begin + in_block_);
          for (std::size_t row = 0; row < in_block_; ++row)
            values[begin + row] = static_cast<Value>(block_[row * width + column]);
        },
        fields_[column].values);
  written_ += in_block_;
  in_block_ = 0;
}

std::vector<StreamField> ColumnStore::take() {
  flush();
  written_ = 0;
  for (StreamField& field : fields_) std::visit([](auto& values) { values.shrink_to_fit(); }, field.values);
  return std::move(fields_);
}

}  // namespace ident::blackbox
