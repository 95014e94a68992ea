// Keeps parameters and the messages that describe the vehicle.
#include "ident/io/dataflash/facts.h"

namespace ident::dataflash {

void Facts::take_parameter(std::string_view name, double value, std::optional<double> t) {
  const auto [at, is_first] = now_.try_emplace(std::string(name), value);
  if (is_first)
    log_.parameters[at->first] = value;
  else if (at->second != value)
    log_.parameter_changes.push_back({t.value_or(0.0), at->first, value});
  at->second = value;
}

void Facts::take_message(std::string_view text) {
  if (text.starts_with("Ardu") || text.starts_with("APM:"))
    log_.facts.try_emplace("firmware", text);
  else if (text.starts_with("Frame: "))
    log_.facts.try_emplace("frame", text.substr(7));
  else if (text.starts_with("ChibiOS") || text.starts_with("PX4:"))
    log_.facts.try_emplace("system", text);
  else if (log_.facts.contains("system"))
    log_.facts.try_emplace("board", text);  // the message behind the system's is the board with its number
}

}  // namespace ident::dataflash
