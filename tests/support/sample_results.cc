// Fills results with smooth curves and seeded noise.
#include "support/sample_results.h"

#include <array>
#include <random>

namespace ident::testing {
namespace {

using Style = Series::Style;

class Noise {
 public:
  double operator()(double sigma) { return sigma * normal_(engine_); }

 private:
  std::mt19937_64 engine_{20};
  std::normal_distribution<double> normal_;
};

std::vector<double> times(double end, double step) {
  std::vector<double> t;
  for (int i = 0; i * step <= end; ++i) t.push_back(i * step);
  return t;
}

std::vector<double> map(const std::vector<double>& x, auto f) {
  std::vector<double> y;
  for (const double value : x) y.push_back(f(value));
  return y;
}

Plot rates(const char* id, const char* title, double frequency, Noise& noise) {
  const std::vector<double> fine = times(20, 0.004), coarse = times(20, 0.02);
  Plot plot{.id = id,
            .title = title,
            .x_label = "t [s]",
            .y_label = "rate [rad/s]",
            .kind = Plot::Kind::time_series};
  plot.caption = "Measured grey, predicted over it, with its 3-sigma band.";
  const auto truth = [=](double t) {
    return std::sin(frequency * t) * std::exp(-0.05 * t) + 0.2 * std::sin(7 * t);
  };
  plot.series = {{.name = "p band",
                  .x = coarse,
                  .y = map(coarse, [&](double t) { return truth(t) - 0.15; }),
                  .y2 = map(coarse, [&](double t) { return truth(t) + 0.15; }),
                  .style = Style::band},
                 {.name = "p measured",
                  .x = fine,
                  .y = map(fine, [&](double t) { return t > 8 && t < 8.6 ? kNaN : truth(t) + noise(0.05); }),
                  .style = Style::measured},
                 {.name = "p predicted", .x = coarse, .y = map(coarse, truth), .style = Style::predicted}};
  return plot;
}

Plot thrust_fit(Noise& noise) {
  const std::vector<double> speeds = times(900, 15), line = times(900, 5);
  Plot plot{
      .id = "fit", .title = "Thrust over rotor speed", .x_label = "Omega [rad/s]", .y_label = "thrust [N]"};
  plot.caption = "The quadratic law and its 95 % band, error bars of one standard deviation.";
  const auto law = [](double w) { return 6e-6 * w * w; };
  plot.series = {{.name = "thrust band",
                  .x = line,
                  .y = map(line, [&](double w) { return law(w) - 0.05 - 1e-4 * w; }),
                  .y2 = map(line, [&](double w) { return law(w) + 0.05 + 1e-4 * w; }),
                  .style = Style::band},
                 {.name = "thrust",
                  .x = speeds,
                  .y = map(speeds, [&](double w) { return law(w) + noise(0.08); }),
                  .y2 = std::vector<double>(speeds.size(), 0.12),
                  .style = Style::points},
                 {.name = "thrust predicted", .x = line, .y = map(line, law), .style = Style::predicted},
                 {.name = "a + b Omega + c Omega^2", .x = line, .y = map(line, [&](double w) {
                                                                  return law(w) + 0.1 - 2e-4 * w;
                                                                })}};
  return plot;
}

Plot histogram(Noise& noise) {
  Plot plot{.id = "hist",
            .title = "Residuals of the thrust",
            .x_label = "residual / sigma [-]",
            .y_label = "density [-]"};
  std::array<double, 33> bins{};
  for (int i = 0; i < 4000; ++i) {
    const double bin = std::floor(noise(1) * 4 + 16.5);
    if (bin >= 0 && bin < 33) bins[static_cast<std::size_t>(bin)] += 4.0 / 4000;
  }
  const std::vector<double> centre = [] {
    std::vector<double> x;
    for (int i = 0; i < 33; ++i) x.push_back((i - 16) / 4.0);
    return x;
  }();
  plot.series = {{.name = "residuals", .x = centre, .y = {bins.begin(), bins.end()}, .style = Style::bars},
                 {.name = "normal", .x = centre, .y = map(centre, [](double x) {
                                                   return std::exp(-x * x / 2) / 2.5066;
                                                 })}};
  return plot;
}

Plot spectrum(Noise& noise) {
  Plot plot{.id = "spectrum",
            .title = "Spectrum of the residual",
            .x_label = "frequency [Hz]",
            .y_label = "density [(rad/s)^2/Hz]",
            .log_x = true,
            .log_y = true};
  std::vector<double> f;
  for (double x = 0.05; x < 125; x *= 1.01) f.push_back(x);
  const auto psd = [&](double x) { return 1e-3 / (1 + x * x / 9) * std::exp(noise(0.4)); };
  plot.series = {{.name = "p", .x = f, .y = map(f, psd)},
                 {.name = "q", .x = f, .y = map(f, psd)},
                 {.name = "r", .x = f, .y = map(f, [&](double x) { return 0.3 * psd(x); })}};
  return plot;
}

Plot scatter(Noise& noise) {
  Plot plot{.id = "signature",
            .title = "The signature of rotor drag",
            .x_label = "v_x [m/s]",
            .y_label = "residual Fx [N]"};
  plot.caption = "Residual force against airspeed, with the effect as it was fitted.";
  Series dots{.name = "Fx", .style = Style::points};
  for (int i = 0; i < 20000; ++i) {
    dots.x.push_back(noise(2.5));
    dots.y.push_back(-0.2 * dots.x.back() + noise(0.15));
  }
  const std::vector<double> line{-9, 9};
  plot.series = {dots,
                 {.name = "rotor_drag predicted", .x = line, .y = {1.8, -1.8}, .style = Style::predicted}};
  return plot;
}

Plot waterfall() {
  Plot plot{.id = "waterfall", .title = "How far the gap closes", .y_label = "share of the gap [%]"};
  plot.column_names = {"gap", "rotor_drag", "cg_offset", "imu_bias", "remaining"};
  plot.series = {
      {.name = "gap", .x = {0, 4}, .y = {100, 7}, .style = Style::bars},
      {.name = "closed", .x = {1, 2, 3}, .y = {38, 15, 7}, .y2 = {100, 38, 15}, .style = Style::bars}};
  return plot;
}

Plot shares() {
  Plot plot{.id = "shares", .title = "Probability of each effect", .y_label = "probability [-]"};
  plot.column_names = {"rotor_drag",     "parasitic_drag", "translational_lift",  "axial_inflow",
                       "blade_flapping", "ground_effect",  "products_of_inertia", "imu_misalignment"};
  plot.series = {{.name = "probability",
                  .x = {0, 1, 2, 3, 4, 5, 6, 7},
                  .y = {0.993, 0.21, 0.05, 0.02, 0.33, 0.001, 0.04, 0.0},
                  .style = Style::bars}};
  return plot;
}

Plot regimes() {
  Plot plot{.id = "regimes",
            .title = "Where the model mispredicts",
            .x_label = "airspeed [m/s]",
            .y_label = "channel",
            .kind = Plot::Kind::heat_map};
  plot.row_names = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  plot.column_names = {"0-1", "1-2", "2-3", "3-4", "4-6", "6-8", "8-10"};
  plot.cells = Eigen::MatrixXd(6, 7);
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 7; ++c) plot.cells(r, c) = c * c * (6 - r) / 216.0;
  plot.cells(3, 3) = kNaN;
  return plot;
}

Parameter parameter(const char* name, double value, double std, const char* unit, const char* source) {
  return {.name = name,
          .value = value,
          .std = std,
          .ci95 = {value - 1.96 * std, value + 1.96 * std},
          .unit = unit,
          .source = source,
          .naive_std = 0.4 * std,
          .prior_value = value * 1.01,
          .prior_std = 10 * std,
          .pull = 0.3,
          .from_flight = 0.97};
}

void add_origin(Result& result) {
  result.inputs = {"flight_01.csv"};
  result.files = {{"flight_01.csv", "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08"}};
  result.command_line = {"ident", result.command, "flight_01.csv", "--report", "report.html"};
  result.seed = 7;
}

}  // namespace

Result sample_parameter_result() {
  Noise noise;
  Result r;
  r.command = "flightlog";
  r.verdict =
      "Nine of ten parameters were identified from two flights of 20 s; kT is known to 0.4 %, the inertias "
      "to 3 %. "
      "The prediction over half a second leaves 1.2 times the sensor noise. One thing needs attention: the "
      "yaw "
      "inertia and the torque coefficient were excited too little to be told apart.";
  r.parameters = {parameter("kT", 6.0143e-6, 1.2e-8, "N s^2/rad^2", "thrust"),
                  parameter("kQ", 1.021e-7, 2.4e-9, "N m s^2/rad^2", "thrust"),
                  parameter("km", 947.2, 3.1, "rad/s", "motor"),
                  parameter("omega_m", 31.2, 0.9, "rad/s", "motor"),
                  parameter("Jxx", 2.93e-3, 8e-5, "kg m^2", "flightlog"),
                  parameter("Jyy", 2.98e-3, 9e-5, "kg m^2", "flightlog"),
                  parameter("Jzz", 5.3e-3, 9e-4, "kg m^2", "prior")};
  r.parameters.back().identifiable = false;
  r.parameters.back().note = "only Jzz/kQ is determined; fly yaw doublets of 30 deg/s or more";
  r.fit = {{"samples", 5001}, {"r2", 0.9871}, {"rmse", {{"p", 0.0512}, {"q", 0.0533}}}};
  r.warn("low_excitation", "Yaw moved by less than 0.1 rad/s rms. Add yaw doublets, then run again.");
  r.warn("tare_offset",
         "Thrust at rest was 0.21 N and has been taken off. Tare the stand before the next sweep.");
  Table health{.title = "Signals", .columns = {"Signal", "Rate [Hz]", "Gaps", "Noise", "Frame"}};
  health.rows = {{"p, q, r", "250", "1 (0.6 s)", "0.050 rad/s", "FRD"},
                 {"attitude", "50.0", "0", "0.0010 rad", "NED"}};
  r.sections = {
      {.title = "Data health", .text = "Two rates; times are uniform to 0.1 ms.", .tables = {health}},
      {.title = "Prediction",
       .text = "",
       .plots = {rates("p", "Roll rate", 2, noise), rates("q", "Roll rate, second flight", 3, noise)}},
      {.title = "Thrust", .text = "", .plots = {thrust_fit(noise), histogram(noise), spectrum(noise)}}};
  r.correlation = {{"kT", "kQ", "km", "omega_m", "Jxx", "Jyy", "Jzz"}, Eigen::MatrixXd::Identity(7, 7)};
  r.correlation.matrix(1, 6) = r.correlation.matrix(6, 1) = 0.98;
  r.correlation.matrix(0, 2) = r.correlation.matrix(2, 0) = -0.64;
  r.correlation.matrix(4, 5) = r.correlation.matrix(5, 4) = 0.21;
  add_origin(r);
  return r;
}

Result sample_gap_result() {
  Noise noise;
  Result r;
  r.schema = "ident.gap/1";
  r.command = "gap";
  r.verdict =
      "The model lacks rotor_drag (probability 0.993). Adding it closes 93 % of the gap on held-out flight.";
  Table effects{.title = "All effects", .columns = {"Effect", "Probability", "Closed", "Parameter", "Unit"}};
  effects.rows = {{"rotor_drag", "0.993", "93 %", "(8.10 ± 0.20)e-5", "kg/rad"},
                  {"blade_flapping", "0.33", "41 %", "–", ""}};
  r.sections = {{.title = "Where", .text = "Fast flight.", .plots = {regimes()}},
                {.title = "Which", .text = "", .tables = {effects}, .plots = {shares(), scatter(noise)}},
                {.title = "How far", .text = "", .plots = {waterfall()}}};
  add_origin(r);
  return r;
}

Result large_result() {
  Noise noise;
  Result r;
  r.command = "flightlog";
  Section section{.title = "Record"};
  const std::vector<double> t = times(999.99, 0.01);
  Plot plot{.id = "large",
            .title = "Six channels",
            .x_label = "t [s]",
            .y_label = "rate [rad/s]",
            .kind = Plot::Kind::time_series};
  for (int i = 0; i < 6; ++i)
    plot.series.push_back(
        {.name = "omega" + std::to_string(i + 1),
         .x = t,
         .y = map(t, [&](double x) { return i + std::sin(x * (i + 1) / 10) + noise(0.1); })});
  section.plots = {plot};
  r.sections = {section};
  return r;
}

}  // namespace ident::testing
