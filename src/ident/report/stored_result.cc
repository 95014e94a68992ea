// One list of fields for each type serves both directions, so that what is written is what is read.
#include "ident/report/stored_result.h"

#include <concepts>
#include <set>
#include <type_traits>

#include "ident/core/version.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "ident.stored/1";

// The fields of each type. `T` is const when writing.

template <typename T, typename V>
concept Is = std::same_as<std::remove_const_t<T>, V>;

template <Is<Parameter> T, typename Visit>
void visit_fields(T& p, Visit visit) {
  visit("name", p.name), visit("value", p.value), visit("std", p.std), visit("ci95", p.ci95);
  visit("unit", p.unit), visit("identifiable", p.identifiable), visit("source", p.source);
  visit("naive_std", p.naive_std), visit("prior_value", p.prior_value), visit("prior_std", p.prior_std);
  visit("pull", p.pull), visit("from_flight", p.from_flight), visit("note", p.note);
  visit("joint", p.joint);
}

template <Is<Warning> T, typename Visit>
void visit_fields(T& w, Visit visit) {
  visit("code", w.code), visit("message", w.message);
}

template <Is<Series> T, typename Visit>
void visit_fields(T& s, Visit visit) {
  visit("name", s.name), visit("style", s.style), visit("x", s.x), visit("y", s.y), visit("y2", s.y2);
}

template <Is<Plot> T, typename Visit>
void visit_fields(T& p, Visit visit) {
  visit("id", p.id), visit("title", p.title), visit("caption", p.caption), visit("x_label", p.x_label);
  visit("y_label", p.y_label), visit("kind", p.kind), visit("log_x", p.log_x), visit("log_y", p.log_y);
  visit("series", p.series), visit("cells", p.cells), visit("row_names", p.row_names);
  visit("column_names", p.column_names);
}

template <Is<Table> T, typename Visit>
void visit_fields(T& t, Visit visit) {
  visit("title", t.title), visit("columns", t.columns), visit("rows", t.rows);
}

template <Is<Section> T, typename Visit>
void visit_fields(T& s, Visit visit) {
  visit("title", s.title), visit("text", s.text), visit("tables", s.tables), visit("plots", s.plots);
}

template <Is<InputFile> T, typename Visit>
void visit_fields(T& f, Visit visit) {
  visit("path", f.path), visit("sha256", f.sha256);
}

template <Is<Result> T, typename Visit>
void visit_fields(T& r, Visit visit) {
  visit("result_schema", r.schema), visit("command", r.command), visit("inputs", r.inputs);
  visit("parameters", r.parameters), visit("fit", r.fit), visit("warnings", r.warnings);
  visit("extra", r.extra), visit("verdict", r.verdict), visit("sections", r.sections);
  visit("correlation_names", r.correlation.names), visit("correlation", r.correlation.matrix);
  visit("prior_correlation_names", r.prior_correlation.names);
  visit("prior_correlation", r.prior_correlation.matrix);
  visit("files", r.files), visit("command_line", r.command_line), visit("seed", r.seed);
  visit("version", r.version);
}

template <typename T>
concept Plain = std::same_as<T, std::string> || std::same_as<T, bool> || std::same_as<T, std::uint64_t> ||
    std::same_as<T, Json>;

template <Plain T>
Json write(const T& x) {
  return x;
}
template <Plain T>
void read(const Json& j, T& x) {
  x = j.get<T>();
}

// JSON has no NaN and no infinities.
Json write(double x) {
  if (std::isnan(x)) return nullptr;
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  return x;
}
void read(const Json& j, double& x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (j.is_null())
    x = kNaN;
  else if (j.is_string())
    x = j.get<std::string>() == "-inf" ? -kInfinity : kInfinity;
  else
    x = j.get<double>();
}

template <typename T>
requires std::is_enum_v<T> Json write(T x) { return static_cast<int>(x); }
template <typename T>
requires std::is_enum_v<T>
void read(const Json& j, T& x) { x = static_cast<T>(j.get<int>()); }

Json write(const std::array<double, 2>& x) { return {write(x[0]), write(x[1])}; }
void read(const Json& j, std::array<double, 2>& x) { read(j.at(0), x[0]), read(j.at(1), x[1]); }

Json write(const Eigen::MatrixXd& x) {
  Json cells = Json::array();
  for (const double cell : x.reshaped()) cells.push_back(write(cell));
  return {{"rows", x.rows()}, {"columns", x.cols()}, {"cells", cells}};
}
void read(const Json& j, Eigen::MatrixXd& x) {
  x.resize(j.at("rows").get<Eigen::Index>(), j.at("columns").get<Eigen::Index>());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    read(j.at("cells").at(static_cast<std::size_t>(i)), x.reshaped()[i]);
}

template <typename T>
concept Structure = requires(T& x) {
  visit_fields(x, [](const char*, auto&) {});
};

template <Structure T>
Json write(const T& x);
template <Structure T>
void read(const Json& j, T& x);

template <typename T>
Json write(const std::optional<T>& x) {
  return x ? Json::array({write(*x)}) : Json(nullptr);
}
template <typename T>
void read(const Json& j, std::optional<T>& x) {
  if (!j.is_null()) read(j.at(0), x.emplace());
}

template <typename T>
Json write(const std::vector<T>& items) {
  Json j = Json::array();
  for (const T& item : items) j.push_back(write(item));
  return j;
}
template <typename T>
void read(const Json& j, std::vector<T>& items) {
  items.resize(j.size());
  for (std::size_t i = 0; i < items.size(); ++i) read(j.at(i), items[i]);
}

template <Structure T>
Json write(const T& x) {
  Json j = Json::object();
  visit_fields(x, [&](const char* name, const auto& field) { j[name] = write(field); });
  return j;
}
template <Structure T>
void read(const Json& j, T& x) {
  // What older versions did not write yet keeps its default.
  static const std::set<std::string> newer = {"joint", "prior_correlation_names", "prior_correlation"};
  visit_fields(x, [&](const char* name, auto& field) {
    if (j.contains(name) || !newer.contains(name)) read(j.at(name), field);
  });
}

}  // namespace

Json stored_json(const Result& result) {
  Json j{{"schema", kSchema}};
  j.update(write(result));
  if (result.version.empty()) j["version"] = version();
  return j;
}

Result result_from_json(const Json& stored) {
  if (stored.at("schema") != kSchema)
    throw nlohmann::json::other_error::create(501, "not a result stored by ident", &stored);
  Result result;
  read(stored, result);
  return result;
}

}  // namespace ident
