// Counts notes of damage and keeps the first ones.
#include "ident/io/packed/damage.h"

#include <fmt/format.h>

namespace ident {

namespace {
constexpr std::size_t kShown = 10;  // notes; a damaged file repeats itself
}

void DamageNotes::add(std::uint64_t byte, const std::string& what) {
  if (notes_.size() < kShown)
    notes_.push_back(fmt::format("byte {}: {}", byte, what));
  else
    ++left_out_;
}

void DamageNotes::close() {
  if (left_out_ > 0) notes_.push_back(fmt::format("and {} more damaged places", left_out_));
}

}  // namespace ident
