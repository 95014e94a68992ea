// Gazebo (gz-sim): SDF with its multicopter motor model.
#include "ident/io/simulators/sdf/gazebo_motors.h"
#include "ident/io/simulators/sdf/gazebo_page.h"
#include "ident/io/simulators/sdf/sdf_fields.h"
#include "ident/io/simulators/sdf/sdf_model.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr GazeboDialect kDialect{.plugin = "multicopter-motor-model",
                                 .filename = "gz-sim-multicopter-motor-model-system",
                                 .name = "gz::sim::systems::MulticopterMotorModel",
                                 .relative_airspeed = false};

bool recognises(std::string_view text) {
  // A model without any motor plugin is taken too: the base of one that includes it.
  return text.find("<sdf") != std::string_view::npos &&
         text.find("gazebo_motor_model") == std::string_view::npos;
}

}  // namespace

SimulatorFormat gz_format() {
  return {
      .target = "gz",
      .meaning = "Gazebo (gz-sim): an SDF model with the multicopter motor plugin",
      .holds = gazebo_capacity(kDialect),
      .recognises = recognises,
      .read = [](const std::string& text,
                 const std::string& file) { return sdf_fields(text, file, kDialect.plugin); },
      .vehicle = [](const Fields& fields) { return gazebo_vehicle(fields, kDialect); },
      .stand_in = [](const Vehicle&, Vehicle& v) { gazebo_stand_in(v); },
      .values = [](const Vehicle& v, const Fields* own) { return gazebo_values(v, own, kDialect); },
      .page = [](const Vehicle& v, const Values& values) { return gazebo_page(v, values, kDialect); },
      .remarks = [](const Vehicle& whole, const Vehicle& v) { return gazebo_remarks(whole, v, kDialect); }};
}

}  // namespace ident
