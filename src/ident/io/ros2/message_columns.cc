// Turns the messages of one topic into columns: nested fields as `pose.position.x`, elements as `data[3]`.
#include "ident/io/ros2/message_columns.h"

#include <fmt/format.h>

#include <limits>

namespace ident::ros2 {

namespace {

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::int64:
    case Type::uint64:
    case Type::float64:
      return 8;
    default:
      return 1;
  }
}

/// Calls `use` with the number of the given type.
template <typename Use>
void with_number(Type type, CdrReader& in, Use use) {
  switch (type) {
    case Type::int8:
      return use(in.number<std::int8_t>());
    case Type::int16:
      return use(in.number<std::int16_t>());
    case Type::uint16:
      return use(in.number<std::uint16_t>());
    case Type::int32:
      return use(in.number<std::int32_t>());
    case Type::uint32:
      return use(in.number<std::uint32_t>());
    case Type::int64:
      return use(in.number<std::int64_t>());
    case Type::uint64:
      return use(in.number<std::uint64_t>());
    case Type::float32:
      return use(in.number<float>());
    case Type::float64:
      return use(in.number<double>());
    default:
      return use(in.number<std::uint8_t>());
  }
}

}  // namespace

bool MessageColumns::add(std::span<const std::uint8_t> message) {
  CdrReader in(message);
  if (in.ok()) run(steps_, in);
  if (!problem_.empty()) return false;
  constexpr std::size_t padding = 7;  // writers fill up to 4 or 8 bytes
  const bool fits = in.ok() && in.left() <= padding;
  if (fits) ++rows_;
  even_out(fits);
  return fits;
}

/// Gives every column of a sequence NaN where the last message had none; takes away what a message that
/// failed has added.
void MessageColumns::even_out(bool good) {
  const auto fit = [this](auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    constexpr bool floating = std::is_floating_point_v<Value>;
    values.resize(rows_, floating ? std::numeric_limits<Value>::quiet_NaN() : Value{});
  };
  if (good)
    for (const std::size_t column : of_sequences_) std::visit(fit, columns_[column].values);
  else
    for (StreamField& column : columns_) std::visit(fit, column.values);
}

const StreamField* MessageColumns::find(std::string_view name) const {
  for (const StreamField& column : columns_)
    if (column.name == name) return &column;
  return nullptr;
}

void MessageColumns::read_number(const Step& step, CdrReader& in) {
  with_number(step.type, in, [&](auto number) {
    if (step.column == no_column || !in.ok()) return;
    StoredValues& values = columns_[step.column].values;
    if (auto* same = std::get_if<std::vector<decltype(number)>>(&values))
      same->push_back(number);
    else if (auto* floating = std::get_if<std::vector<double>>(&values))
      floating->push_back(static_cast<double>(number));
  });
}

void MessageColumns::run_sequence(Step& step, CdrReader& in) {
  const bool nested = step.type == Type::nested;
  const std::uint32_t count = step.repeat == Repeat::array ? step.count
                                                           : in.length(step.type == Type::string ? 4
                                                                       : nested                  ? 1
                                                                                : size_of(step.type));
  const std::uint32_t with_columns = step.field ? std::min(count, most_elements) : 0;
  while (step.elements.size() < with_columns && problem_.empty()) {
    MessageField element = *step.field;
    element.name = fmt::format("{}[{}]", step.name, step.elements.size());
    element.repeat = Repeat::once;
    plan_single(element, {.prefix = {}, .in_sequence = true, .depth = 1}, step.elements.emplace_back());
  }
  if (!problem_.empty()) return;
  for (std::uint32_t i = 0; i < with_columns && in.ok(); ++i) run(step.elements[i], in);
  if (!nested && step.type != Type::string) return in.skip(count - with_columns, size_of(step.type));
  for (std::uint32_t i = with_columns; i < count && in.ok(); ++i) {
    if (nested)
      run(step.element, in);
    else
      in.string();
  }
}

void MessageColumns::run(std::vector<Step>& steps, CdrReader& in) {
  for (Step& step : steps) {
    if (!in.ok()) return;
    if (step.repeat != Repeat::once) {
      run_sequence(step, in);
    } else if (step.type == Type::string) {
      const std::string_view text = in.string();
      if (!step.name.empty() && in.ok()) texts_.try_emplace(step.name, text);
    } else {
      read_number(step, in);
    }
  }
}

}  // namespace ident::ros2
