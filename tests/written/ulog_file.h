// The container of PX4's ULog: definitions first, then subscriptions and data in the order of time.
#pragma once

#include <map>

#include "bytes.h"

namespace written {

class UlogFile {
 public:
  // `format` is "name:type field;..." as the firmware writes it, trailing padding included.
  void define(const std::string& format);
  void info(const std::string& typed_key, const Bytes& value);
  void info(const std::string& key, const std::string& value);  // as char[n]
  void parameter(const std::string& name, float value);
  void parameter(const std::string& name, std::int32_t value);
  void default_parameter(const std::string& name, float value);
  void data(const std::string& topic, std::uint64_t time_us, const Bytes& record);
  void text(std::uint64_t time_us, const std::string& message);
  void write(const std::string& path) const;

 private:
  void message(Bytes& to, char type, const Bytes& payload) const;

  Bytes formats_, facts_, parameters_;
  std::vector<std::string> topics_;
  std::multimap<std::uint64_t, std::pair<int, Bytes>> records_;  // topic index, or -1 for text
};

}  // namespace written
