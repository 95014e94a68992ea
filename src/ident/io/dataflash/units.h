// Units of columns, as FMTU, UNIT and MULT messages state them.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace ident::dataflash {

class Units {
 public:
  void name_unit(char id, std::string_view unit) { units_[id] = unit; }
  void name_multiplier(char id, double multiplier) { multipliers_[id] = multiplier; }
  void assign(int kind, std::string_view unit_ids, std::string_view multiplier_ids) {
    of_kind_[kind] = {std::string(unit_ids), std::string(multiplier_ids)};
  }

  /// Unit of a column once the scale of its letter is applied: `rad/s`, `us`. Empty where none is stated, or
  /// where letter and multiplier together make no unit that has a name.
  std::string unit(int kind, std::size_t column, double letter_scale) const;

 private:
  struct Ids {
    std::string units, multipliers;
  };
  std::map<char, std::string> units_;
  std::map<char, double> multipliers_;
  std::map<int, Ids> of_kind_;
};

}  // namespace ident::dataflash
