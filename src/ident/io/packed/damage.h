// Notes on what could not be read of a log, as many as a reader wants to see.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ident {

class DamageNotes {
 public:
  explicit DamageNotes(std::vector<std::string>& notes) : notes_(notes) {}
  void add(std::uint64_t byte, const std::string& what);
  /// Adds how many more there were. Call once, at the end.
  void close();

 private:
  std::vector<std::string>& notes_;
  std::size_t left_out_ = 0;
};

}  // namespace ident
