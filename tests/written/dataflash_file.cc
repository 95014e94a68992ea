// Format letters as in LogStructure.h.
#include "dataflash_file.h"

#include <cmath>

namespace written {
namespace {

size_t width(char letter) {
  switch (letter) {
    case 'b':
    case 'B':
    case 'M':
      return 1;
    case 'h':
    case 'H':
    case 'c':
    case 'C':
      return 2;
    case 'q':
    case 'Q':
    case 'd':
      return 8;
    case 'N':
      return 16;
    case 'Z':
      return 64;
    default:
      return 4;
  }
}

void pack(Bytes& out, char letter, double value) {
  const auto whole = [&](double scale) { return std::llround(value * scale); };
  switch (letter) {
    case 'b':
      out.put(static_cast<std::int8_t>(whole(1)));
      break;
    case 'B':
    case 'M':
      out.put(static_cast<std::uint8_t>(whole(1)));
      break;
    case 'h':
      out.put(static_cast<std::int16_t>(whole(1)));
      break;
    case 'H':
      out.put(static_cast<std::uint16_t>(whole(1)));
      break;
    case 'i':
      out.put(static_cast<std::int32_t>(whole(1)));
      break;
    case 'I':
      out.put(static_cast<std::uint32_t>(whole(1)));
      break;
    case 'c':
      out.put(static_cast<std::int16_t>(whole(100)));
      break;
    case 'C':
      out.put(static_cast<std::uint16_t>(whole(100)));
      break;
    case 'e':
      out.put(static_cast<std::int32_t>(whole(100)));
      break;
    case 'E':
      out.put(static_cast<std::uint32_t>(whole(100)));
      break;
    case 'L':
      out.put(static_cast<std::int32_t>(whole(1e7)));
      break;
    case 'q':
      out.put(static_cast<std::int64_t>(whole(1)));
      break;
    case 'Q':
      out.put(static_cast<std::uint64_t>(whole(1)));
      break;
    case 'f':
      out.put(static_cast<float>(value));
      break;
    case 'd':
      out.put(value);
      break;
    default:
      throw std::runtime_error("unknown format letter");
  }
}

const std::map<char, const char*> kUnits = {
    {'-', ""},      {'#', "instance"}, {'%', "%"},   {'A', "A"},     {'E', "rad/s"}, {'J', "W.s"},
    {'O', "degC"},  {'X', "W.h"},      {'Y', "us"},  {'a', "Ah"},    {'d', "deg"},   {'h', "degheading"},
    {'k', "deg/s"}, {'m', "m"},        {'n', "m/s"}, {'o', "m/s/s"}, {'q', "rpm"},   {'s', "s"},
    {'v', "V"},     {'w', "Ohm"},      {'z', "Hz"}};
const std::map<char, double> kMultipliers = {{'-', 0},    {'?', 1},    {'0', 1},    {'1', 1e1},
                                             {'2', 1e2},  {'A', 1e-1}, {'B', 1e-2}, {'C', 1e-3},
                                             {'D', 1e-4}, {'E', 1e-5}, {'F', 1e-6}, {'/', 3600}};

}  // namespace

DataflashFile::DataflashFile() {
  define({128, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns", "-b---", "-----"});
}

void DataflashFile::define(const DataflashFormat& format) {
  size_t length = 3;
  for (const char letter : format.letters) length += width(letter);
  begin(128).put(format.id).put(static_cast<std::uint8_t>(length));
  out_.field(format.name, 4).field(format.letters, 16).field(format.columns, 64);
  formats_[format.name] = format;
}

void DataflashFile::units() {
  for (const auto& [id, label] : kUnits) record("UNIT", {0, static_cast<double>(id)}, label);
  for (const auto& [id, factor] : kMultipliers) record("MULT", {0, static_cast<double>(id), factor});
  for (const auto& [name, format] : formats_) {
    begin(formats_.at("FMTU").id);
    out_.put(std::uint64_t{0}).put(format.id).field(format.units, 16).field(format.multipliers, 16);
  }
}

void DataflashFile::record(const std::string& name, std::initializer_list<double> values,
                           const std::string& text) {
  const DataflashFormat& format = formats_.at(name);
  begin(format.id);
  auto value = values.begin();
  for (const char letter : format.letters) {
    if (letter == 'N' || letter == 'Z')
      out_.field(text, width(letter));
    else if (value != values.end())
      pack(out_, letter, *value++);
    else
      throw std::runtime_error("too few values for " + name);
  }
  if (value != values.end()) throw std::runtime_error("too many values for " + name);
}

}  // namespace written
