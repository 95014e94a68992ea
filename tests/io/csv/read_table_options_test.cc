// Bench files without a header, and bench files with a map.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ident/core/error.h"
#include "ident/io/csv/read_table.h"
#include "ident/io/csv/table_map.h"
#include "ident/io/csv/table_schemas.h"

namespace ident {
namespace {

std::string written(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / ("ident-table-" + name);
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

constexpr double kGramForce = 9.80665e-3;             // N
constexpr double kRpm = 2.0 * 3.14159265358979 / 60;  // rad/s

TEST(ReadTable, TakesANamedHeaderAndPassesOverWhatStandsBeforeTheRows) {
  const std::string file =
      written("banner.csv", "Stand 3, 2026\nset;get;speed\n1200;100;1000\n1300;400;2000\n");
  const NumberTable table = read_table(file, thrust_schema(), {.names = "pwm,thrust_gf,rpm"});
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_DOUBLE_EQ((*table.find("u"))[1], 1300.0);
  EXPECT_NEAR((*table.find("thrust"))[1], 400.0 * kGramForce, 1e-12);
  EXPECT_NEAR((*table.find("omega"))[0], 1000.0 * kRpm, 1e-9);
  EXPECT_EQ(table.line[0], 3);
}

TEST(ReadTable, RefusesANamedHeaderOfAnotherWidthThanTheRows) {
  const std::string file = written("width.csv", "1200,100,1000\n1300,400,2000\n");
  EXPECT_THROW(read_table(file, thrust_schema(), {.names = "pwm,thrust"}), InputError);
}

TEST(ReadTable, TakesColumnsUnitsAndScalesFromAMap) {
  const std::string file =
      written("mapped.csv", "Speed,Cell 1,thrust\n1000,-100,7\n2000,-400,7\n3000,-900,7\n");
  const std::string map = written("map.yaml",
                                  "columns:\n  omega: {column: Speed, unit: rpm}\n"
                                  "  thrust: {column: Cell 1, unit: gf, scale: -1}\n");
  const TableMap read = read_table_map(map, thrust_schema());
  const NumberTable table = read_table(file, thrust_schema(), {.map = &read});
  EXPECT_NEAR((*table.find("omega"))[2], 3000.0 * kRpm, 1e-9);
  EXPECT_NEAR((*table.find("thrust"))[2], 900.0 * kGramForce, 1e-12);
}

TEST(ReadTable, AMapThatNamesWhatIsNotThereIsAnError) {
  const std::string file = written("lacks.csv", "Speed,thrust\n1000,1\n2000,2\n");
  const TableMap lacks = read_table_map(written("lacks.yaml", "columns: {omega: Sped}\n"), thrust_schema());
  EXPECT_THROW(read_table(file, thrust_schema(), {.map = &lacks}), InputError);
  EXPECT_THROW(read_table_map(written("signal.yaml", "columns: {lift: Speed}\n"), thrust_schema()),
               InputError);
  EXPECT_THROW(
      read_table_map(written("unit.yaml", "columns: {omega: {column: Speed, unit: N}}\n"), thrust_schema())
          .columns.at("nothing"),
      std::out_of_range);
}

}  // namespace
}  // namespace ident
