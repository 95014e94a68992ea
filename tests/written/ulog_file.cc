// Messages of ULog, version 1.
#include "ulog_file.h"

#include <algorithm>

namespace written {
namespace {

Bytes keyed(const std::string& key, const Bytes& value) {
  return Bytes().put(static_cast<std::uint8_t>(key.size())).text(key).append(value);
}

}  // namespace

void UlogFile::message(Bytes& to, char type, const Bytes& payload) const {
  to.put(static_cast<std::uint16_t>(payload.size())).put(type).append(payload);
}

void UlogFile::define(const std::string& format) { message(formats_, 'F', Bytes().text(format)); }

void UlogFile::info(const std::string& typed_key, const Bytes& value) {
  message(facts_, 'I', keyed(typed_key, value));
}

void UlogFile::info(const std::string& key, const std::string& value) {
  info("char[" + std::to_string(value.size()) + "] " + key, Bytes().text(value));
}

void UlogFile::parameter(const std::string& name, float value) {
  message(parameters_, 'P', keyed("float " + name, Bytes().put(value)));
}

void UlogFile::parameter(const std::string& name, std::int32_t value) {
  message(parameters_, 'P', keyed("int32_t " + name, Bytes().put(value)));
}

void UlogFile::default_parameter(const std::string& name, float value) {
  const std::uint8_t system_wide = 1;
  message(parameters_, 'Q', Bytes().put(system_wide).append(keyed("float " + name, Bytes().put(value))));
}

void UlogFile::data(const std::string& topic, std::uint64_t time_us, const Bytes& record) {
  auto found = std::find(topics_.begin(), topics_.end(), topic);
  if (found == topics_.end()) found = topics_.insert(found, topic);
  records_.emplace(time_us, std::pair(static_cast<int>(found - topics_.begin()), record));
}

void UlogFile::text(std::uint64_t time_us, const std::string& line) {
  records_.emplace(time_us, std::pair(-1, Bytes().put('6').put(time_us).text(line)));
}

void UlogFile::write(const std::string& path) const {
  Bytes out;
  out.text("ULog").each<std::uint8_t>(0x01, 0x12, 0x35, 1).put(records_.begin()->first);
  message(out, 'B', Bytes().put(std::uint8_t{1}).zeros(39));  // compat[0] bit 0: default parameters
  out.append(formats_).append(facts_).append(parameters_);
  for (size_t i = 0; i < topics_.size(); ++i)
    message(out, 'A', Bytes().put(std::uint8_t{0}).put(static_cast<std::uint16_t>(i)).text(topics_[i]));
  for (const auto& [time, record] : records_) {
    const auto& [topic, payload] = record;
    if (topic < 0)
      message(out, 'L', payload);
    else
      message(out, 'D', Bytes().put(static_cast<std::uint16_t>(topic)).append(payload));
  }
  out.write(path);
}

}  // namespace written
