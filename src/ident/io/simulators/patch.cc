// Replaces numbers in a user's own file by their places: comments and layout stay byte for byte.
#include "ident/io/simulators/patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/io/simulators/lost.h"
#include "ident/io/simulators/reduced.h"

namespace ident {
namespace {

struct Edit {
  std::size_t at, size;
  std::string text;
};

// What a quotient of numbers of 13 digits may be off: no reason to touch a value.
bool same(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

bool says_the_same(const Value& a, const Value& b) {
  return a.name == b.name && a.word == b.word && std::ranges::equal(a.numbers, b.numbers, same);
}

std::string joined(const Value& value, std::string_view separator) {
  std::string out;
  for (const double number : value.numbers)
    out += (out.empty() ? "" : std::string(separator)) + value_text(number);
  return out;
}

/// Edits that make a field of the file hold a value; none where it does already.
void edit_field(const Fields& fields, const Value& value, std::vector<Edit>& edits) {
  const Field& field = fields.at(value.name);
  if (!value.word.empty()) {
    if (field.text != value.word) edits.push_back({field.begin, field.size, value.word});
    return;
  }
  if (field.numbers.size() != value.numbers.size())
    fields.fail(value.name,
                fmt::format("has {} numbers, the vehicle {}", field.numbers.size(), value.numbers.size()));
  bool all_same = true;
  for (std::size_t i = 0; i < value.numbers.size(); ++i)
    all_same = all_same && same(field.numbers[i].value, value.numbers[i]);
  if (all_same) return;
  if (field.computed) {
    edits.push_back({field.begin, field.size, field.open + joined(value, ", ") + field.close});
    return;
  }
  for (std::size_t i = 0; i < value.numbers.size(); ++i)
    if (!same(field.numbers[i].value, value.numbers[i]))
      edits.push_back({field.numbers[i].begin, field.numbers[i].size, value_text(value.numbers[i])});
}

}  // namespace

SimulatorExport patch_simulator(const SimulatorFormat& format, const std::string& text,
                                const std::string& file, const Vehicle& vehicle, const Vehicle* unchanged) {
  if (!format.recognises)
    throw UsageError(fmt::format("--into: files of {} are only written, not patched", format.target));
  if (!format.recognises(text))
    throw InputError(file, 0, "",
                     fmt::format("is no file of {} (or its fields are not there)", format.target));
  const Fields fields = format.read(text, file);
  SimulatorExport out{.reduced = held_by(format, vehicle),
                      .lost = lost(vehicle, format.holds, format.target)};
  if (format.remarks)
    for (std::string& remark : format.remarks(vehicle, out.reduced)) out.lost.push_back(std::move(remark));
  std::vector<Edit> edits;
  const std::vector<Value> as_before =
      unchanged ? format.values(held_by(format, *unchanged), &fields) : std::vector<Value>();
  for (const Value& value : format.values(out.reduced, &fields)) {
    if (std::ranges::any_of(as_before, [&](const Value& v) { return says_the_same(v, value); })) continue;
    if (fields.has(value.name) && !fields.at(value.name).elsewhere.empty()) {
      std::vector<Edit> there;
      edit_field(fields, value, there);
      if (!there.empty())
        out.notes.push_back(fmt::format("{}: {}: stands in {}: patch that file too (it would be {})", file,
                                        value.name, fields.at(value.name).elsewhere, joined(value, " ")));
    } else if (fields.has(value.name)) {
      edit_field(fields, value, edits);
    } else if (const Insertion* where = fields.insertion(value.name)) {
      if (!std::ranges::all_of(value.numbers, [&](double x) { return same(x, where->absent); }))
        edits.push_back({where->at, 0, where->before + joined(value, " ") + where->after});
    } else if (const double absent = value.absent.value_or(0.0);
               value.word.empty() &&
               std::ranges::any_of(value.numbers, [&](double x) { return !same(x, absent); })) {
      out.notes.push_back(fmt::format("{}: {}: stands nowhere in the file and was not added (it would be {})",
                                      file, value.name, joined(value, " ")));
    }
  }
  std::ranges::stable_sort(edits, {}, &Edit::at);
  std::size_t from = 0;
  for (const Edit& edit : edits) {
    out.text.append(text, from, edit.at - from).append(edit.text);
    from = edit.at + edit.size;
  }
  out.text.append(text, from);
  return out;
}

}  // namespace ident
