// An SQLite database that lies in memory, read only, with a bound on the work of each query.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace ident::rosbag2 {

/// Rows of a query, one after the other. What a row gives is valid until the next.
class Rows {
 public:
  explicit Rows(sqlite3_stmt* statement) : statement_(statement) {}
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  ~Rows();

  bool next();
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  std::span<const std::uint8_t> blob(int column) const;

 private:
  sqlite3_stmt* statement_;  ///< null where the query was refused
};

class Database {
 public:
  /// The bytes must stay. A database whose log was not merged (journal mode WAL) is copied.
  explicit Database(std::string_view bytes);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  bool has_table(const std::string& name);
  Rows query(const std::string& sql);
  /// What went wrong last; empty where nothing did.
  std::string problem() const;

 private:
  sqlite3* connection_ = nullptr;
  std::vector<unsigned char> copy_;
  std::int64_t work_left_ = 0;
  bool interrupted_ = false;

  static int count_work(void* self);
};

}  // namespace ident::rosbag2
