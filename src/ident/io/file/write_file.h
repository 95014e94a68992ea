// Outputs that appear whole or not at all, also when the program is killed or the disk is full.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ident {

/// Writes a file: temporary file beside it, fsync, rename. Throws OutputError; what stood there stays.
/// Temporary files that a killed program left for the same target are removed. A device is written directly.
void write_whole(const std::string& path, std::string_view content);

/// Throws OutputError where the folder of a file to be written is not there: known before the work, not
/// after.
void require_folder_of(const std::string& path);

/// Several outputs of one command: all appear or none does. Nothing is visible before `commit`.
class Outputs {
 public:
  Outputs();
  ~Outputs();  ///< what was not committed vanishes
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// Content of a file; the last content given for a path counts.
  void add(const std::string& path, std::string content);
  /// Content given for a path so far, or nullptr.
  const std::string* find(const std::string& path) const;
  /// Writes every temporary file; afterwards only a rename is left to do.
  void prepare();
  /// Makes them visible (prepares first where that was not done).
  void commit();

 private:
  struct Pending;
  std::vector<std::unique_ptr<Pending>> pending_;
};

}  // namespace ident
