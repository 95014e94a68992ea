// The two loops of the server: step by step with the autopilot, or against the clock.
#include "ident/fly/serve.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "ident/core/error.h"
#include "ident/fly/flight_record.h"

namespace ident {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWait = 0.1;       // s between two looks at `stop`
constexpr double kSilence = 1.0;    // s without commands after which motors stop
constexpr double kBehind = 0.25;    // s behind the clock that are not caught up any more
constexpr int kAtOnce = 1000;       // datagrams read between two steps
constexpr std::size_t kKinds = 20;  // kinds of wrong datagrams that are told apart

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Server::Server(const Autopilot& autopilot, const Vehicle& vehicle, const ServeOptions& options)
    : autopilot_(&autopilot),
      options_(options),
      socket_(options.address, options.port),
      vehicle_(vehicle, options.legs),
      range_(vehicle.command.value_or(CommandRange{1000.0, 2000.0})),
      delta_(vehicle.rotors.size(), 0.0),
      peer_(ipv4_address(options.address == "0.0.0.0" ? "127.0.0.1" : options.address)) {
  if (options.rotor_of_output.size() != vehicle.rotors.size())
    throw UsageError("each rotor has to be driven by one output of the autopilot");
}

Served Server::run() {
  if (options_.listening) options_.listening(vehicle_.readings());
  options_.rate > 0 ? against_the_clock() : lockstep();
  served_.last = vehicle_.readings();
  return std::move(served_);
}

bool Server::ended() const {
  constexpr double kRounding = 1e-9;  // s
  return served_.seconds >= options_.seconds - kRounding || (options_.stop && options_.stop());
}

void Server::lockstep() {
  while (!ended())
    if (const std::optional<Datagram> datagram = socket_.receive(kWait)) answer(*datagram);
}

void Server::answer(const Datagram& datagram) {
  const Commands commands = autopilot_->read(datagram.bytes);
  if (!accepted(commands)) return;
  if (commands.frame && frame_ && *commands.frame == *frame_) {
    ++served_.repeated;
    return socket_.send(datagram.from, answer_);
  }
  if (commands.frame && frame_ && *commands.frame < *frame_) restart();
  if (commands.frame && frame_ && heard_) served_.lost += *commands.frame - *frame_ - 1;
  frame_ = commands.frame;
  delta_ = delta(commands);
  heard_ = true;
  ++served_.frames;
  step(commands.step);
  answer_ = autopilot_->write(vehicle_.readings());
  socket_.send(datagram.from, answer_);
}

void Server::against_the_clock() {
  const double h = 1.0 / options_.rate;
  const Clock::time_point start = Clock::now();
  double due = h;
  while (!ended()) {
    const double wait = due - seconds_since(start);
    if (wait < -kBehind) served_.late -= wait, due -= wait;
    if (wait > 0) {
      if (const std::optional<Datagram> datagram = socket_.receive(std::min(wait, kWait))) take(*datagram);
      continue;
    }
    std::optional<Datagram> datagram;
    for (int i = 0; i < kAtOnce && (datagram = socket_.receive(0.0)); ++i) take(*datagram);
    silence_ += h;
    if (silence_ > kSilence) std::ranges::fill(delta_, 0.0);
    step(h);
    socket_.send({peer_, options_.state_port}, autopilot_->write(vehicle_.readings()));
    due += h;
  }
}

void Server::take(const Datagram& datagram) {
  const Commands commands = autopilot_->read(datagram.bytes);
  if (!accepted(commands)) return;
  if (heard_ && silence_ > kSilence) restart();
  silence_ = 0.0;
  heard_ = true;
  peer_ = datagram.from.address;
  ++served_.frames;
  delta_ = delta(commands);
}

bool Server::accepted(const Commands& commands) {
  std::string wrong = commands.refused;
  if (wrong.empty() && commands.pulse_us.size() < vehicle_.vehicle().rotors.size())
    wrong =
        fmt::format("{} outputs for {} rotors", commands.pulse_us.size(), vehicle_.vehicle().rotors.size());
  if (wrong.empty()) return true;
  if (served_.refused.size() >= kKinds && !served_.refused.contains(wrong)) wrong = "other faults";
  ++served_.refused[wrong];
  return false;
}

std::vector<double> Server::delta(const Commands& commands) const {
  std::vector<double> out(delta_.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[options_.rotor_of_output[i]] =
        std::clamp((commands.pulse_us[i] - range_.min_us) / (range_.max_us - range_.min_us), 0.0, 1.0);
  return out;
}

void Server::restart() {
  vehicle_.restart();
  frame_.reset();
  served_.log = {};
  ++served_.restarts;
}

void Server::step(double seconds) {
  if (options_.record && heard_) add_row(served_.log, vehicle_.readings(), vehicle_.felt(delta_));
  vehicle_.step(delta_, seconds);
  if (heard_) served_.seconds += seconds;
  if (options_.progress) options_.progress(vehicle_.readings());
}

}  // namespace ident
