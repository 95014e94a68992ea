// Gazebo classic with PX4's motor plugin: SDF; thrust falls with the speed along the axis.
#include "ident/io/simulators/sdf/gazebo_motors.h"
#include "ident/io/simulators/sdf/gazebo_page.h"
#include "ident/io/simulators/sdf/sdf_fields.h"
#include "ident/io/simulators/sdf/sdf_model.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr GazeboDialect kDialectClassic{.plugin = "gazebo_motor_model",
                                        .filename = "libgazebo_motor_model.so",
                                        .name = "",
                                        .relative_airspeed = true};

bool recognises(std::string_view text) {
  return text.find("<sdf") != std::string_view::npos &&
         text.find(kDialectClassic.plugin) != std::string_view::npos;
}

}  // namespace

SimulatorFormat gz_classic_format() {
  return {
      .target = "gz-classic",
      .meaning = "Gazebo classic: an SDF model with libgazebo_motor_model.so",
      .holds = gazebo_capacity(kDialectClassic),
      .recognises = recognises,
      .read = [](const std::string& text,
                 const std::string& file) { return sdf_fields(text, file, kDialectClassic.plugin); },
      .vehicle = [](const Fields& fields) { return gazebo_vehicle(fields, kDialectClassic); },
      .stand_in = [](const Vehicle&, Vehicle& v) { gazebo_stand_in(v); },
      .values = [](const Vehicle& v, const Fields* own) { return gazebo_values(v, own, kDialectClassic); },
      .page = [](const Vehicle& v, const Values& values) { return gazebo_page(v, values, kDialectClassic); },
      .remarks = [](const Vehicle& whole,
                    const Vehicle& v) { return gazebo_remarks(whole, v, kDialectClassic); }};
}

}  // namespace ident
