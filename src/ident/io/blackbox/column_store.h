// Rows of integers in, typed columns out, with little more memory than the columns take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ident/data/log_streams.h"

namespace ident::blackbox {

/// Type in which a column is kept. Blackbox numbers have 32 bits; only times are longer.
enum class Stored : std::uint8_t { int32, uint32, int64 };

struct ColumnKind {
  std::string name;
  std::string unit;
  double scale = 1.0;
  Stored stored = Stored::int32;
};

/// Collects rows and turns them into columns a block at a time.
class ColumnStore {
 public:
  explicit ColumnStore(std::vector<ColumnKind> columns);
  /// As many numbers as there are columns. The space returned is valid until the next call.
  std::span<std::int64_t> next_row();
  /// The columns; the store is empty afterwards.
  std::vector<StreamField> take();
  std::size_t rows() const { return written_ + in_block_; }

 private:
  void flush();

  std::vector<StreamField> fields_;
  std::vector<std::int64_t> block_;  ///< row after row
  std::size_t rows_of_block_ = 8;    ///< grows with the log
  std::size_t in_block_ = 0;
  std::size_t written_ = 0;
};

}  // namespace ident::blackbox
