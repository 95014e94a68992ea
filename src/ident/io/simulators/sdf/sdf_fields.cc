// Finds links, joints and motor plugins in an SDF model, its own and those of an included one.
#include "ident/io/simulators/sdf/sdf_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ident/core/error.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/simulators/readers/xml_document.h"

namespace ident {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kLargestFile = 16u << 20;
constexpr const char* kMoments[] = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};

/// An entry of a motor plugin and the plugin's default.
struct MotorEntry {
  const char* name;
  double absent;
};
constexpr MotorEntry kMotor[] = {
    {"timeConstantUp", 1.0 / 80},       {"timeConstantDown", 1.0 / 40},     {"maxRotVelocity", 838.0},
    {"motorConstant", 8.54858e-06},     {"momentConstant", 0.016},          {"rotorDragCoefficient", 1e-4},
    {"rollingMomentCoefficient", 1e-6}, {"rotorVelocitySlowdownSim", 10.0}, {"maxRelativeAirspeed", 25.0}};

struct Motor {
  int number = 0;
  std::string link;
  pugi::xml_node plugin;
};

class Model {
 public:
  Model(const std::string& text, const std::string& file, std::string_view plugin)
      : document_(text, file), fields_(text, file) {
    if (std::string_view(document_.root().name()) != "sdf")
      document_.fail(document_.root(), "is no SDF: the root has to be sdf");
    model_ = document_.root().child("model");
    if (!model_) document_.fail(document_.root(), "has no model");
    find_motors(plugin);
  }

  Fields fields() {
    for (std::size_t n = 0; n < motors_.size(); ++n)
      add_motor(motors_[n].plugin, fmt::format("rotor{}.", n + 1));
    add_links();
    return fields_;
  }
  const std::vector<Motor>& motors() const { return motors_; }
  /// The rotors as another file numbers them.
  void take_motors(const std::vector<Motor>& motors) { motors_ = motors; }
  std::string included() const { return model_.child("include").child("uri").text().as_string(); }
  bool has_links() const { return static_cast<bool>(model_.child("link")); }

  /// Only the links, for an included model.
  Fields links() {
    add_links();
    return fields_;
  }

 private:
  void find_motors(std::string_view name) {
    for (const pugi::xml_node plugin : elements_below(model_, "plugin")) {
      if (std::string_view(plugin.attribute("filename").value()).find(name) == std::string_view::npos)
        continue;
      const pugi::xml_node number =
          plugin.child("motorNumber") ? plugin.child("motorNumber") : plugin.child("actuator_number");
      if (!plugin.child("linkName")) document_.fail(plugin, "names no link (linkName)");
      motors_.push_back({number ? number.text().as_int() : static_cast<int>(motors_.size()),
                         plugin.child("linkName").text().as_string(), plugin});
    }
    std::ranges::stable_sort(motors_, {}, &Motor::number);
    if (motors_.size() > 8) document_.fail(motors_[8].plugin, "is the ninth motor: eight are read");
    if (!motors_.empty()) return;
    for (const pugi::xml_node link :
         model_.children("link"))  // a model without plugins: links by their names
      if (const std::string own = link.attribute("name").value();
          own.starts_with("rotor_") && motors_.size() < 8)
        motors_.push_back({static_cast<int>(motors_.size()), own, {}});
  }

  void add_motor(pugi::xml_node plugin, const std::string& key) {
    if (!plugin) return;
    for (const auto& [name, absent] : kMotor) {
      document_.add_numbers(fields_, key + name, plugin.child(name));
      if (!plugin.child(name) && plugin.child("motorConstant"))
        document_.can_insert_behind(fields_, key + name, plugin.child("motorConstant"), name, absent);
    }
    document_.add_word(fields_, key + "turningDirection", plugin.child("turningDirection"));
  }

  std::string key_of(const std::string& name, int& others) {
    for (std::size_t n = 0; n < motors_.size(); ++n)
      if (motors_[n].link == name || name.ends_with("/" + motors_[n].link))
        return fmt::format("rotor{}.", n + 1);
    if (name == base_) return "base.";
    return fmt::format("link{}.", ++others);
  }

  void find_base() {
    if (model_.find_child_by_attribute("link", "name", "base_link")) base_ = "base_link";
    double most = -1.0;
    if (base_.empty())  // the heaviest link
      for (const pugi::xml_node link : model_.children("link"))
        if (const double m = link.child("inertial").child("mass").text().as_double(); m > most)
          most = m, base_ = link.attribute("name").value();
  }

  void add_links() {
    find_base();
    int others = 0;
    for (const pugi::xml_node link : model_.children("link")) {
      const std::string key = key_of(link.attribute("name").value(), others);
      const pugi::xml_node pose = link.child("pose"), inertial = link.child("inertial");
      const std::string_view frame = pose.attribute("relative_to").value();
      if (!frame.empty() && frame != base_ && frame != "__model__")
        document_.fail(pose,
                       fmt::format("is relative to '{}': poses in the frame of the model are read", frame));
      document_.add_numbers(fields_, key + "pose", pose.text().empty() ? pugi::xml_node() : pose);
      if (inertial.child("pose") && !inertial.child("pose").text().empty())
        document_.add_numbers(fields_, key + "inertial", inertial.child("pose"));
      document_.add_numbers(fields_, key + "mass", inertial.child("mass"));
      for (const char* name : kMoments)
        document_.add_numbers(fields_, key + name, inertial.child("inertia").child(name));
      if (key == "base." && inertial.child("mass") && !inertial.child("pose"))
        document_.can_insert_behind(fields_, "base.inertial", inertial.child("mass"), "pose", 0.0);
    }
  }

  XmlDocument document_;
  Fields fields_;
  pugi::xml_node model_;
  std::vector<Motor> motors_;
  std::string base_;
};

/// The file of model://NAME beside the folder of this one; empty where it is not there.
std::string beside(const std::string& file, const std::string& uri) {
  constexpr std::string_view scheme = "model://";
  const std::string name = uri.starts_with(scheme) ? uri.substr(scheme.size()) : uri;
  if (name.empty() || name.find("..") != std::string::npos) return {};
  const fs::path found = fs::path(file).parent_path() / ".." / name / "model.sdf";
  std::error_code failed;
  return fs::is_regular_file(found, failed) ? found.lexically_normal().string() : std::string();
}

}  // namespace

Fields sdf_fields(const std::string& text, const std::string& file, std::string_view plugin) {
  Model model(text, file, plugin);
  Fields fields = model.fields();
  if (model.has_links() || model.included().empty()) return fields;
  const std::string other = beside(file, model.included());
  if (other.empty())
    throw InputError(
        file, 0, "include",
        fmt::format("'{}' is not beside the folder of this file: it holds the masses", model.included()));
  Model base(read_bytes(other, kLargestFile), other, plugin);
  if (!model.motors().empty()) base.take_motors(model.motors());
  const Fields links = base.links();
  for (auto [name, field] : links.all()) {
    field.elsewhere = other;
    if (!fields.has(name)) fields.add(name, std::move(field));
  }
  return fields;
}

}  // namespace ident
