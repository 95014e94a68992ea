// C99: one header without dependencies that holds the constants and the state derivative of the full model.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/full/full_model.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr const char* kUsage = R"(
/* State: attitude quaternion body to world (w, x, y, z), body rates, velocity and position in the world, rotor speeds
   and their rates. Body forward, right, down; world north, east, down. SI units. */
typedef struct {
  double q[4], w[3], v[3], x[3], Omega[MODEL_ROTORS], Omega_dot[MODEL_ROTORS];
} model_state;
)";

constexpr const char* kHelpers = R"(
static inline void model_cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
static inline double model_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void model_rotation(const double q[4], double R[3][3]) {
  R[0][0] = 1 - 2 * (q[2] * q[2] + q[3] * q[3]), R[0][1] = 2 * (q[1] * q[2] - q[0] * q[3]), R[0][2] = 2 * (q[1] * q[3] + q[0] * q[2]);
  R[1][0] = 2 * (q[1] * q[2] + q[0] * q[3]), R[1][1] = 1 - 2 * (q[1] * q[1] + q[3] * q[3]), R[1][2] = 2 * (q[2] * q[3] - q[0] * q[1]);
  R[2][0] = 2 * (q[1] * q[3] - q[0] * q[2]), R[2][1] = 2 * (q[2] * q[3] + q[0] * q[1]), R[2][2] = 1 - 2 * (q[1] * q[1] + q[2] * q[2]);
}

/* Thrust and drag torque of a rotor; v is the air-relative velocity of its hub, height that above the ground. */
static inline void model_rotor(const model_constants* p, int n, double Omega, const double v[3], double height, double* T, double* Q) {
  const double* a = p->rotor_a[n];
  const double along = model_dot(v, a), across2 = model_dot(v, v) - along * along;
  const double x = Omega * sqrt(MODEL_ROTORS * p->kT / (p->m * p->g)), beyond = x - 1;
  *T = p->kT * Omega * Omega + p->translational_lift_kh * across2 - p->axial_inflow_kz * Omega * along;
  if (p->ground_effect_radius_sq != 0) {
    const double z = 0.5 * (height + sqrt(height * height + 1e-4)), ratio = p->ground_effect_radius_sq / (16 * z * z + 1e-9);
    *T /= 1 - ratio / sqrt(sqrt(1 + pow(4 * ratio, 4)));
  }
  *T *= 1 + p->thrust_curve_c * beyond + p->thrust_curve_offset * (beyond * beyond / (x * x + 0.02));
  *T *= p->rotor_ratio[n];
  *Q = p->kQ * Omega * Omega * p->rotor_ratio[n];
}

/* w' = J^-1 M for a symmetric J. */
static inline void model_solve(const model_constants* p, const double M[3], double out[3]) {
  const double a = p->Jxx, b = p->Jxy, c = p->Jxz, d = p->Jyy, e = p->Jyz, f = p->Jzz;
  const double A = d * f - e * e, B = c * e - b * f, C = b * e - c * d, det = a * A + b * B + c * C;
  out[0] = (A * M[0] + B * M[1] + C * M[2]) / det;
  out[1] = (B * M[0] + (a * f - c * c) * M[1] + (b * c - a * e) * M[2]) / det;
  out[2] = (C * M[0] + (b * c - a * e) * M[1] + (a * d - b * b) * M[2]) / det;
}
)";

constexpr const char* kDerivative = R"(
/* Rates of change of a state; delta: commands 0 to 1, dead_time ago; wind in the world, or NULL. */
static inline model_state model_derivative(const model_constants* p, const model_state* s, const double delta[MODEL_ROTORS],
                                           const double wind[3]) {
  model_state out;
  double R[3][3], air[3], v[3] = {0, 0, 0}, F[3] = {0, 0, 0}, M[3] = {0, 0, 0}, turned[3], h[3] = {0, 0, 0};
  const double c[3] = {p->cg_offset_x, p->cg_offset_y, p->cg_offset_z}, Kd[3] = {p->Kdx, p->Kdy, p->Kdz};
  model_rotation(s->q, R);
  for (int i = 0; i < 3; ++i) air[i] = s->v[i] - (wind ? wind[i] : 0);
  for (int i = 0; i < 3; ++i) v[i] = R[0][i] * air[0] + R[1][i] * air[1] + R[2][i] * air[2];
  for (int n = 0; n < MODEL_ROTORS; ++n) {
    const double *r = p->rotor_r[n], *a = p->rotor_a[n], Omega = s->Omega[n];
    double hub[3], F_n[3], M_n[3], T, Q;
    model_cross(s->w, r, turned);
    for (int i = 0; i < 3; ++i) hub[i] = v[i] + turned[i];
    const double height = p->ground_z - (s->x[2] + R[2][0] * r[0] + R[2][1] * r[1] + R[2][2] * r[2]);
    model_rotor(p, n, Omega, hub, height, &T, &Q);
    const double along = model_dot(hub, a), momentum = p->reaction_sign * p->rotor_s[n] * p->Jp;
    for (int i = 0; i < 3; ++i) F_n[i] = T * a[i] - p->rotor_drag_kd * Omega * (hub[i] - along * a[i]);
    model_cross(r, F_n, M_n);
    model_cross(hub, a, turned);
    for (int i = 0; i < 3; ++i) {
      F[i] += F_n[i];
      M[i] += M_n[i] - p->rotor_s[n] * Q * a[i] + p->blade_flapping_kf * Omega * turned[i] - momentum * s->Omega_dot[n] * a[i];
      h[i] += momentum * Omega * a[i];
    }
    const double target = p->Omega_0 + p->km * delta[n];
    const double omega_m = p->omega_m * (Omega > target ? p->motor_asymmetry_ratio : 1);
    out.Omega[n] = s->Omega_dot[n];
    out.Omega_dot[n] = omega_m * omega_m * (target - Omega) - 2 * p->zeta_m * omega_m * s->Omega_dot[n];
  }
  model_cross(s->w, h, turned);
  for (int i = 0; i < 3; ++i) M[i] -= turned[i];
  /* Drag of the airframe, at the centre of gravity. */
  const double speed = sqrt(model_dot(v, v) + 1e-6);
  double body[3], at_c[3];
  for (int i = 0; i < 3; ++i)
    body[i] = -p->parasitic_drag_C * speed * v[i] - (R[0][i] * Kd[0] * s->v[0] + R[1][i] * Kd[1] * s->v[1] + R[2][i] * Kd[2] * s->v[2]);
  model_cross(c, body, at_c);
  for (int i = 0; i < 3; ++i) F[i] += body[i], M[i] += at_c[i];
  const double Jw[3] = {p->Jxx * s->w[0] + p->Jxy * s->w[1] + p->Jxz * s->w[2], p->Jxy * s->w[0] + p->Jyy * s->w[1] + p->Jyz * s->w[2],
                        p->Jxz * s->w[0] + p->Jyz * s->w[1] + p->Jzz * s->w[2]};
  model_cross(s->w, Jw, turned);
  model_cross(c, F, at_c);
  for (int i = 0; i < 3; ++i) M[i] -= turned[i] + at_c[i];
  model_solve(p, M, out.w);
  /* Specific force at the origin, which is c off the centre of gravity. */
  double f[3], inner[3];
  model_cross(out.w, c, turned);
  model_cross(s->w, c, inner);
  model_cross(s->w, inner, at_c);
  for (int i = 0; i < 3; ++i) f[i] = F[i] / p->m - turned[i] - at_c[i];
  for (int i = 0; i < 3; ++i) out.v[i] = R[i][0] * f[0] + R[i][1] * f[1] + R[i][2] * f[2], out.x[i] = s->v[i];
  out.v[2] += p->g;
  const double *q = s->q, *w = s->w;
  out.q[0] = 0.5 * (-q[1] * w[0] - q[2] * w[1] - q[3] * w[2]), out.q[1] = 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]);
  out.q[2] = 0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]), out.q[3] = 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);
  return out;
}
)";

std::string comment(std::string text) {
  for (std::size_t at = 0; (at = text.find("*/", at)) != std::string::npos;) text.replace(at, 2, "* /");
  return text;
}

std::string page(const Vehicle& v, const Values& values) {
  const std::size_t n = v.rotors.size();
  std::string out = fmt::format(
      "/* Flight model of {}, written by ident. C99, no dependency but math.h. */\n#ifndef "
      "IDENT_MODEL_H\n#define "
      "IDENT_MODEL_H\n#include <math.h>\n#define MODEL_ROTORS {}\n\ntypedef struct {{\n",
      comment(values.source), n);
  std::string set;
  for (const Value& value : values.all()) {
    const std::string size = !is_of_rotors(value)        ? ""
                             : value.numbers.size() == n ? "[MODEL_ROTORS]"
                                                         : "[MODEL_ROTORS][3]";
    out += fmt::format("  double {}{}; /* {} */\n", value.name, size, comment(values.note(value.name)));
    std::string text = values.text(value.name, ", ");
    if (value.numbers.size() == 3 * n && is_of_rotors(value)) {
      text.clear();
      for (std::size_t i = 0; i < 3 * n; ++i)
        text += (i % 3 ? ", " : i ? "}, {" : "{") + value_text(value.numbers[i]);
      text += "}";
    }
    set += fmt::format("    .{} = {},\n", value.name, is_of_rotors(value) ? "{" + text + "}" : text);
  }
  return out + "} model_constants;\n\nstatic const model_constants model_identified = {\n" + set + "};\n" +
         kUsage + kHelpers + kDerivative + "#endif\n";
}

}  // namespace

SimulatorFormat c99_format() {
  return {.target = "c99",
          .meaning = "C99: model.h with constants and state derivative, no dependencies",
          .holds = full_model_capacity(),
          .values = [](const Vehicle& v, const Fields*) { return full_model_values(v); },
          .page = page,
          .remarks = [](const Vehicle& whole, const Vehicle&) { return full_model_remarks(whole); }};
}

}  // namespace ident
