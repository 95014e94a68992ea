// `--name value` pairs of the campaign's programs.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

namespace mended {

class CommandLine {
 public:
  // Throws std::invalid_argument for a name that is not among the defaults, or without value.
  CommandLine(int argc, char** argv, std::map<std::string, std::string> defaults)
      : values_(std::move(defaults)) {
    for (int i = 1; i < argc; i += 2) {
      const std::string name = argv[i];
      if (!values_.contains(name)) throw std::invalid_argument("no option is called " + name);
      if (i + 1 >= argc) throw std::invalid_argument(name + " needs a value");
      values_[name] = argv[i + 1];
    }
  }
  const std::string& text(const std::string& name) const { return values_.at(name); }
  const std::string& required(const std::string& name) const {
    if (values_.at(name).empty()) throw std::invalid_argument(name + " is needed");
    return values_.at(name);
  }
  int integer(const std::string& name) const { return std::stoi(values_.at(name)); }

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace mended
