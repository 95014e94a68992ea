// CasADi: a Python module with the constants and the symbolic state derivative of the full model.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/full/full_model.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr const char* kModel = R"(

def rotation(q):
    """Body to world, of a quaternion w, x, y, z."""
    w, x, y, z = ca.vertsplit(q)
    return ca.vertcat(
        ca.horzcat(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        ca.horzcat(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        ca.horzcat(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))

def rotor(p, n, Omega, v, height):
    """Thrust and drag torque; v is the air-relative velocity of the hub."""
    N = len(p["rotor_s"])
    a = ca.DM(p["rotor_a"][n])
    along = ca.dot(v, a)
    x = Omega * ca.sqrt(N * p["kT"] / (p["m"] * p["g"]))
    T = (p["kT"] * Omega**2 + p["translational_lift_kh"] * (ca.dot(v, v) - along**2)
         - p["axial_inflow_kz"] * Omega * along)
    z = 0.5 * (height + ca.sqrt(height**2 + 1e-4))
    near = p["ground_effect_radius_sq"] / (16 * z**2 + 1e-9)
    T = T / (1 - near / (1 + (4 * near)**4)**0.25)
    T = T * (1 + p["thrust_curve_c"] * (x - 1) + p["thrust_curve_offset"] * (x - 1)**2 / (x**2 + 0.02))
    return T * p["rotor_ratio"][n], p["kQ"] * Omega**2 * p["rotor_ratio"][n]

def derivative(p, q, w, v, x, Omega, Omega_dot, delta, wind=(0, 0, 0)):
    """Rates of change of q, w, v, x, Omega, Omega_dot. Body forward, right, down; world north, east, down.

    delta: commands 0 to 1, dead_time ago. Works with SX, MX and DM.
    """
    R = rotation(q)
    c = ca.DM([p["cg_offset_x"], p["cg_offset_y"], p["cg_offset_z"]])
    J = ca.DM([[p["Jxx"], p["Jxy"], p["Jxz"]], [p["Jxy"], p["Jyy"], p["Jyz"]], [p["Jxz"], p["Jyz"], p["Jzz"]]])
    v_air = R.T @ (v - ca.DM(list(wind)))
    F, M, h, Omega_ddot = 0, 0, 0, []
    for n in range(len(p["rotor_s"])):
        r, a, s = ca.DM(p["rotor_r"][n]), ca.DM(p["rotor_a"][n]), p["rotor_s"][n]
        hub = v_air + ca.cross(w, r)
        T, Q = rotor(p, n, Omega[n], hub, p["ground_z"] - (x[2] + (R @ r)[2]))
        F_n = T * a - p["rotor_drag_kd"] * Omega[n] * (hub - ca.dot(hub, a) * a)
        momentum = p["reaction_sign"] * s * p["Jp"]
        F = F + F_n
        M = (M + ca.cross(r, F_n) - s * Q * a + p["blade_flapping_kf"] * Omega[n] * ca.cross(hub, a)
             - momentum * Omega_dot[n] * a)
        h = h + momentum * Omega[n] * a
        target = p["Omega_0"] + p["km"] * delta[n]
        omega_m = p["omega_m"] * ca.if_else(Omega[n] > target, p["motor_asymmetry_ratio"], 1)
        Omega_ddot.append(omega_m**2 * (target - Omega[n]) - 2 * p["zeta_m"] * omega_m * Omega_dot[n])
    body = -p["parasitic_drag_C"] * ca.sqrt(ca.dot(v_air, v_air) + 1e-6) * v_air
    body = body - R.T @ (ca.DM([p["Kdx"], p["Kdy"], p["Kdz"]]) * v)
    F = F + body
    M = M - ca.cross(w, h) + ca.cross(c, body) - ca.cross(c, F) - ca.cross(w, J @ w)
    w_dot = ca.inv(J) @ M
    f = F / p["m"] - ca.cross(w_dot, c) - ca.cross(w, ca.cross(w, c))
    q_dot = 0.5 * ca.vertcat(-ca.dot(q[1:], w), q[0] * w + ca.cross(q[1:], w))
    return q_dot, w_dot, R @ f + ca.DM([0, 0, p["g"]]), v, Omega_dot, ca.vertcat(*Omega_ddot)
)";

std::string page(const Vehicle& v, const Values& values) {
  std::string out = fmt::format(
      "# Flight model of {}, written by ident.\nimport casadi as ca\n\nidentified = {{\n", values.source);
  for (const Value& value : values.all()) {
    std::string text = values.text(value.name, ", ");
    if (is_of_rotors(value) && value.numbers.size() == 3 * v.rotors.size()) {
      text.clear();
      for (std::size_t i = 0; i < value.numbers.size(); ++i)
        text += (i % 3 ? ", " : i ? "], [" : "[") + value_text(value.numbers[i]);
      text += "]";
    }
    out += fmt::format("    \"{}\": {},  # {}\n", value.name, is_of_rotors(value) ? "[" + text + "]" : text,
                       values.note(value.name));
  }
  return out + "}\n" + kModel;
}

}  // namespace

SimulatorFormat casadi_format() {
  return {.target = "casadi",
          .meaning = "CasADi: constants and symbolic state derivative, in Python",
          .holds = full_model_capacity(),
          .values = [](const Vehicle& v, const Fields*) { return full_model_values(v); },
          .page = page,
          .remarks = [](const Vehicle& whole, const Vehicle&) { return full_model_remarks(whole); }};
}

}  // namespace ident
