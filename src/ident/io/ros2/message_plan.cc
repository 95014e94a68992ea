// Makes the steps in which messages of one type are read into columns.
#include <fmt/format.h>

#include <limits>

#include "ident/io/ros2/message_columns.h"

namespace ident::ros2 {

namespace {

/// Deeper nesting is a type that contains itself.
constexpr int deepest = 16;
/// Steps of a plan: columns, and what is passed over.
constexpr std::size_t most_steps = 4 * most_columns;

StoredValues empty_values(Type type) {
  switch (type) {
    case Type::boolean:
    case Type::uint8:
      return std::vector<std::uint8_t>{};
    case Type::int8:
      return std::vector<std::int8_t>{};
    case Type::int16:
      return std::vector<std::int16_t>{};
    case Type::uint16:
      return std::vector<std::uint16_t>{};
    case Type::int32:
      return std::vector<std::int32_t>{};
    case Type::uint32:
      return std::vector<std::uint32_t>{};
    case Type::int64:
      return std::vector<std::int64_t>{};
    case Type::uint64:
      return std::vector<std::uint64_t>{};
    case Type::float32:
      return std::vector<float>{};
    default:
      return std::vector<double>{};
  }
}

}  // namespace

MessageColumns::MessageColumns(const Definitions& definitions, std::string_view type)
    : definitions_(definitions) {
  plan_fields(type, {}, steps_);
}

std::size_t MessageColumns::add_column(const std::string& name, Type type, bool in_sequence) {
  if (in_sequence && type != Type::float32) type = Type::float64;
  StreamField column{.name = name, .unit = {}, .values = empty_values(type)};
  if (in_sequence) {
    of_sequences_.push_back(columns_.size());
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();
    if (type == Type::float32)
      column.values = std::vector<float>(rows_, static_cast<float>(missing));
    else
      column.values = std::vector<double>(rows_, missing);
  }
  columns_.push_back(std::move(column));
  return columns_.size() - 1;
}

void MessageColumns::plan_fields(std::string_view type, const Place& place, std::vector<Step>& steps) {
  if (!problem_.empty()) return;
  const auto fields = definitions_.find(type);
  if (fields == definitions_.end()) {
    problem_ = fmt::format("type {} is not defined", type);
    return;
  }
  if (place.depth > deepest) {
    problem_ = fmt::format("type {} contains itself", type);
    return;
  }
  // DDS has no empty structures: ROS puts a byte in.
  if (fields->second.empty()) steps.push_back({});
  for (const MessageField& field : fields->second) {
    if (++steps_planned_ > most_steps || columns_.size() > most_columns)
      problem_ = fmt::format("messages hold more than {} numbers", most_columns);
    if (!problem_.empty()) return;
    plan_field(field, place, steps);
  }
}

void MessageColumns::plan_field(const MessageField& field, const Place& place, std::vector<Step>& steps) {
  if (field.type == Type::wstring) {
    problem_ = fmt::format("field {}{} is a wide string, which is not read", place.prefix, field.name);
    return;
  }
  if (field.repeat == Repeat::once) return plan_single(field, place, steps);
  const bool columns =
      place.columns && (field.repeat == Repeat::sequence || field.count <= most_array_elements);
  if (field.repeat == Repeat::array && columns) {
    for (std::uint32_t i = 0; i < field.count && problem_.empty(); ++i) {
      MessageField element = field;
      element.name = fmt::format("{}[{}]", field.name, i);
      element.repeat = Repeat::once;
      if (++steps_planned_ > most_steps)
        problem_ = fmt::format("messages hold more than {} numbers", most_columns);
      plan_single(element, place, steps);
    }
    return;
  }
  Step step{
      .type = field.type, .repeat = field.repeat, .count = field.count, .name = place.prefix + field.name};
  if (field.type == Type::nested)
    plan_fields(field.nested, {.prefix = {}, .columns = false, .depth = place.depth + 1}, step.element);
  if (columns && field.type != Type::string) step.field = &field;
  steps.push_back(std::move(step));
}

void MessageColumns::plan_single(const MessageField& field, const Place& place, std::vector<Step>& steps) {
  const std::string name = place.prefix + field.name;
  if (field.type == Type::nested) {
    Place inner = place;
    inner.prefix = name + ".";
    ++inner.depth;
    plan_fields(field.nested, inner, steps);
    return;
  }
  Step step{.type = field.type};
  if (field.type == Type::string)
    step.name = place.columns && !place.in_sequence ? name : std::string{};
  else if (place.columns)
    step.column = add_column(name, field.type, place.in_sequence);
  steps.push_back(std::move(step));
}

}  // namespace ident::ros2
