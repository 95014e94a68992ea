// A growing buffer of little-endian bytes, and its file.
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace written {

class Bytes {
 public:
  template <class T>
  Bytes& put(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    data_.insert(data_.end(), raw, raw + sizeof value);
    return *this;
  }
  template <class T, class... From>
  Bytes& each(From... values) {  // each value as a T
    (put(static_cast<T>(values)), ...);
    return *this;
  }
  Bytes& zeros(size_t n) {
    data_.resize(data_.size() + n, 0);
    return *this;
  }
  Bytes& text(std::string_view s) {
    data_.insert(data_.end(), s.begin(), s.end());
    return *this;
  }
  Bytes& field(std::string_view s, size_t width) {  // cut or filled with zeros
    s = s.substr(0, width);
    return text(s).zeros(width - s.size());
  }
  Bytes& append(const Bytes& other) {
    data_.insert(data_.end(), other.data_.begin(), other.data_.end());
    return *this;
  }
  size_t size() const { return data_.size(); }
  const std::vector<char>& data() const { return data_; }

  void write(const std::string& path) const {
    std::ofstream out(path, std::ios::binary);
    out.write(data_.data(), static_cast<std::streamsize>(data_.size()));
    if (!out) throw std::runtime_error("cannot write " + path);
  }

 private:
  std::vector<char> data_;
};

}  // namespace written
