// Bags of ROS 2 in SQLite, written here: with and without the definitions of their types, and damaged.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "ident/core/error.h"
#include "ident/io/rosbag2/format.h"
#include "support/bag_bytes.h"
#include "support/mangled.h"

namespace ident {
namespace {

/// The bytes of a database that these statements make; `?` is the data of a message.
std::string database(const std::string& schema, const std::string& insert,
                     const std::vector<std::string>& messages) {
  sqlite3* connection = nullptr;
  sqlite3_open(":memory:", &connection);
  EXPECT_EQ(sqlite3_exec(connection, schema.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(connection);
  std::int64_t time_ns = 1'700'000'000'000'000'000;
  for (const std::string& message : messages) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(connection, insert.c_str(), -1, &statement, nullptr);
    sqlite3_bind_int64(statement, 1, time_ns += 10'000'000);
    sqlite3_bind_blob(statement, 2, message.data(), static_cast<int>(message.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE);
    sqlite3_finalize(statement);
  }
  sqlite3_int64 size = 0;
  unsigned char* data = sqlite3_serialize(connection, "main", &size, 0);
  std::string bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
  sqlite3_free(data);
  sqlite3_close(connection);
  return bytes;
}

const std::string tables =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
    "serialization_format TEXT NOT "
    "NULL, offered_qos_profiles TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
    "data BLOB NOT "
    "NULL);"
    "INSERT INTO topics VALUES(1, '/temperature', 'sensor_msgs/msg/Temperature', 'cdr', '');"
    "INSERT INTO topics VALUES(2, '/own', 'own_msgs/msg/Thing', 'cdr', '');";
const std::string insert = "INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)";

std::string temperature(int i) {
  return CdrText()
      .number(std::int32_t{0})
      .number(std::uint32_t{0})
      .string("")
      .number(20.0 + i)
      .number(0.5)
      .bytes();
}

std::string bag(int n, const std::string& more = {}) {
  std::vector<std::string> messages;
  for (int i = 0; i < n; ++i) messages.push_back(temperature(i));
  return database(tables + more, insert, messages);
}

TEST(Rosbag2Reader, KnowsTheTypesOfTheCommonPackages) {
  const LogStreams log = Rosbag2Format::read(bag(100), "bag.db3");
  const LogStream* stream = log.find("/temperature");
  ASSERT_TRUE(stream);
  ASSERT_EQ(stream->t.size(), 100u);
  EXPECT_NEAR(stream->t[99], 0.99, 1e-9);
  EXPECT_EQ(stream->find("temperature")->at(99), 119.0);
  ASSERT_EQ(log.damage.size(), 1u);
  EXPECT_NE(log.damage[0].find("/own (own_msgs/msg/Thing) is not read: the bag does not define its type"),
            std::string::npos);
}

TEST(Rosbag2Reader, ReadsTheDefinitionsThatABagHolds) {
  const std::string definitions =
      "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT "
      "NULL, "
      "encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);"
      "INSERT INTO message_definitions VALUES(1, 'own_msgs/msg/Thing', 'ros2msg', 'float32 x', '');";
  const std::string data =
      database(tables + definitions, "INSERT INTO messages(topic_id, timestamp, data) VALUES(2, ?, ?)",
               {CdrText().number(1.5f).bytes()});
  EXPECT_EQ(Rosbag2Format::read(data, "bag.db3").find("/own")->find("x")->at(0), 1.5);
}

TEST(Rosbag2Reader, ReadsABagInTheJournalModeWal) {
  std::string bytes = bag(3);
  bytes[18] = bytes[19] = 2;
  EXPECT_EQ(Rosbag2Format::read(bytes, "bag.db3").find("/temperature")->t.size(), 3u);
}

TEST(Rosbag2Reader, RefusesOtherDatabases) {
  try {
    Rosbag2Format::read(database("CREATE TABLE topics(id INTEGER);", insert, {}), "other.db");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("without the tables of a ROS 2 bag"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(Rosbag2Format::read("SQLite format 3", "cut.db3"), InputError);
  EXPECT_THROW(Rosbag2Format::read(bag(0), "empty.db3"), InputError);
}

TEST(Rosbag2Reader, PrefixesAndFlippedBitsAreReadOrRefused) {
  const std::string bytes = bag(200);
  const auto read = [](std::string_view damaged) { Rosbag2Format::read(damaged, "bag.db3"); };
  read_prefixes(bytes, 500, read);
  read_with_flipped_bits(bytes, 200, 1000, read);
}

/// Tables whose definition asks for endless work are stopped, and views are no tables.
TEST(Rosbag2Reader, DoesNotRunWhatADatabaseAsksFor) {
  const std::string endless =
      "CREATE TABLE topics(id INTEGER, name, type, serialization_format);"
      "CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i AS "
      "topic_id, i AS "
      "timestamp, 'x' AS data FROM n;";
  EXPECT_THROW(Rosbag2Format::read(database(endless, insert, {}), "bag.db3"), InputError);
}

}  // namespace
}  // namespace ident
