// An SQLite database that lies in memory, read only, with a bound on the work of each query.
#include "ident/io/rosbag2/database.h"

#include <sqlite3.h>

namespace ident::rosbag2 {

namespace {

/// Instructions of SQLite's machine after which the work is counted.
constexpr int instructions_of_step = 1000;

}  // namespace

Rows::~Rows() { sqlite3_finalize(statement_); }

bool Rows::next() { return statement_ && sqlite3_step(statement_) == SQLITE_ROW; }

std::int64_t Rows::integer(int column) const { return sqlite3_column_int64(statement_, column); }

std::string Rows::text(int column) const {
  const unsigned char* text = sqlite3_column_text(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  return text ? std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(size))
              : std::string{};
}

std::span<const std::uint8_t> Rows::blob(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  if (!data) return {};
  return {static_cast<const std::uint8_t*>(data), static_cast<std::size_t>(size)};
}

Database::Database(std::string_view bytes) {
  // Bytes 18 and 19 of the file's head are 2 in the journal mode WAL, which needs a second file: it is read
  // as a plain database, without what was not merged yet.
  constexpr std::size_t write_version = 18;
  const bool wal =
      bytes.size() > write_version + 1 && (bytes[write_version] == 2 || bytes[write_version + 1] == 2);
  if (wal) {
    copy_.assign(bytes.begin(), bytes.end());
    copy_[write_version] = copy_[write_version + 1] = 1;
  }
  // SQLite asks for bytes that can be written, and does not write to what is opened as read only.
  unsigned char* data =
      wal ? copy_.data() : reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  if (sqlite3_open_v2(":memory:", &connection_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_MEMORY, nullptr) !=
      SQLITE_OK)
    return;
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_limit(connection_, SQLITE_LIMIT_LENGTH,
                static_cast<int>(std::min<sqlite3_int64>(size, 1'000'000'000)));
  sqlite3_deserialize(connection_, "main", data, size, size, SQLITE_DESERIALIZE_READONLY);
  // A row of a sound bag takes some twenty instructions and has more than twenty bytes.
  work_left_ = 1000 + static_cast<std::int64_t>(bytes.size()) / instructions_of_step * 10;
  sqlite3_progress_handler(connection_, instructions_of_step, &Database::count_work, this);
}

Database::~Database() { sqlite3_close(connection_); }

int Database::count_work(void* self) {
  auto* database = static_cast<Database*>(self);
  database->interrupted_ = --database->work_left_ < 0;
  return database->interrupted_ ? 1 : 0;
}

bool Database::has_table(const std::string& name) {
  Rows rows = query("SELECT name FROM sqlite_master WHERE type = 'table'");
  while (rows.next())
    if (rows.text(0) == name) return true;
  return false;
}

Rows Database::query(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(connection_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
    return Rows(nullptr);
  return Rows(statement);
}

std::string Database::problem() const {
  if (interrupted_) return "its tables take more work than their size allows (damaged)";
  const int code = sqlite3_errcode(connection_);
  if (code == SQLITE_OK || code == SQLITE_ROW || code == SQLITE_DONE) return {};
  return sqlite3_errmsg(connection_);
}

}  // namespace ident::rosbag2
