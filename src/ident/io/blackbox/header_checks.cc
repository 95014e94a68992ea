// Says why the frames of a blackbox header cannot be decoded, before any is tried.
#include "ident/io/blackbox/header_checks.h"

#include <fmt/format.h>

#include "ident/io/blackbox/frame_decoder.h"

namespace ident::blackbox {

namespace {

std::string reason_against(const Header& header, char kind, const FrameDefinition& definition) {
  if (definition.size() > max_fields)
    return fmt::format("{} frames have {} fields, the format allows {}", kind, definition.size(), max_fields);
  for (std::size_t i = 0; i < definition.size(); ++i) {
    const int predictor = definition.predictor[i];
    const std::string& name = definition.names[i];
    if (predictor < 0 || predictor > last_predictor)
      return fmt::format("field {} has predictor {}, which is not known", name, predictor);
    if (!is_known_encoding(definition.encoding[i]))
      return fmt::format("field {} has encoding {}, which is not known", name, definition.encoding[i]);
    if (predictor == static_cast<int>(Predictor::motor_0) && header.I.find("motor[0]") < 0)
      return fmt::format("field {} is predicted from motor[0], which is not logged", name);
    if (predictor == static_cast<int>(Predictor::home_coordinate) &&
        (header.H.find("GPS_home[0]") < 0 || header.H.find("GPS_home[1]") < 0))
      return fmt::format("field {} is predicted from GPS_home, which is not logged", name);
  }
  return {};
}

}  // namespace

std::string reason_against(const Header& header) {
  if (!header.reaches_data) return "it ends within its header, without a frame";
  if (header.I.size() < 2) return "its header does not name the fields of I frames (damaged)";
  if (header.interval_P_numerator < 1 || header.interval_P_denominator < 1)
    return fmt::format("its P interval is {}/{}", header.interval_P_numerator, header.interval_P_denominator);
  for (const auto& [kind, definition] :
       {std::pair{'I', &header.I}, {'P', &header.P}, {'S', &header.S}, {'G', &header.G}, {'H', &header.H}})
    if (std::string reason = reason_against(header, kind, *definition); !reason.empty()) return reason;
  // A byte holds eight fields at best (one tag of tag8_8svb); a header that stores far less is damaged and
  // would make rows of nothing.
  constexpr std::size_t most_fields_a_byte = 16;
  for (const FrameDefinition* definition : {&header.I, &header.P})
    if (definition->size() > most_fields_a_byte * (1 + FrameDecoder(header, *definition).smallest_size()))
      return "its frames store next to nothing (damaged header)";
  return {};
}

}  // namespace ident::blackbox
