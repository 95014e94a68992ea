// Reads maps of bench files.
#include "ident/io/csv/table_map.h"

#include <algorithm>

#include "ident/core/nearest_word.h"
#include "ident/io/file/yaml_value.h"

namespace ident {
namespace {

const std::vector<std::string> kMapKeys = {"columns"};
const std::vector<std::string> kColumnKeys = {"column", "unit", "scale", "offset"};

TableColumn read_column(const YamlValue& value) {
  TableColumn mapped{.line = value.line()};
  if (!value.is_map()) {
    mapped.column = value.text();
  } else {
    value.expect_map(kColumnKeys);
    mapped.column = value.at("column").text();
    if (value.has("unit")) mapped.unit = value.at("unit").text();
    if (value.has("scale")) mapped.scale = value.at("scale").number();
    if (value.has("offset")) mapped.offset = value.at("offset").number();
    if (mapped.scale == 0.0) value.at("scale").fail("is zero");
  }
  if (mapped.column.empty()) value.fail("names no column");
  return mapped;
}

}  // namespace

TableMap read_table_map(const std::string& path, const TableSchema& schema) {
  std::vector<std::string> names;
  for (const Signal& signal : schema.signals) names.push_back(signal.name);
  for (const TextSignal& signal : schema.text) names.push_back(signal.name);
  const YamlValue file = load_yaml(path);
  file.expect_map(kMapKeys);
  TableMap map{.file = path};
  const YamlValue columns = file.at("columns");
  columns.expect_map();
  for (const std::string& key : columns.keys()) {
    const std::string name = key == "rpm" ? "omega" : key;
    if (std::ranges::find(names, name) == names.end())
      columns.at(key).fail("is no signal of a " + schema.kind + did_you_mean(key, names));
    TableColumn mapped = read_column(columns.at(key));
    if (key == "rpm" && mapped.unit.empty()) mapped.unit = "rpm";
    if (!map.columns.emplace(name, mapped).second)
      columns.at(key).fail("is given twice: rpm is another spelling of omega");
  }
  return map;
}

}  // namespace ident
