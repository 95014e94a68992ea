// The container of ArduPilot's DataFlash logs: self-describing records packed by their format letters.
#pragma once

#include <initializer_list>
#include <map>

#include "bytes.h"

namespace written {

struct DataflashFormat {
  std::uint8_t id;
  std::string name, letters, columns, units, multipliers;
};

class DataflashFile {
 public:
  DataflashFile();
  void define(const DataflashFormat& format);
  void units();  // UNIT and MULT tables, FMTU of all formats defined so far
  // Values in the units of the log's reader: 12.34 deg is stored as 1234 by the letter c.
  void record(const std::string& name, std::initializer_list<double> values, const std::string& text = "");
  void write(const std::string& path) const { out_.write(path); }

 private:
  Bytes& begin(std::uint8_t id) { return out_.each<std::uint8_t>(0xa3, 0x95, id); }

  Bytes out_;
  std::map<std::string, DataflashFormat> formats_;
};

}  // namespace written
