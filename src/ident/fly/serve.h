// Serves a vehicle to an autopilot over UDP: datagrams of commands in, datagrams of readings out.
//
// In lockstep each new frame of commands is a step and has one answer: a frame that comes again has the same
// answer again, and a count that goes back puts the vehicle on the ground again. Against the clock readings
// go out at a fixed rate and the latest commands hold; motors stop when none came for a second.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>

#include "ident/data/flight_log.h"
#include "ident/fly/autopilot.h"
#include "ident/fly/udp_socket.h"

namespace ident {

struct ServeOptions {
  std::string address = "127.0.0.1";                         ///< of this machine, where commands arrive
  std::uint16_t port = 0;                                    ///< 0: a free one
  std::uint16_t state_port = 0;                              ///< against the clock: where readings go
  double rate = 0.0;                                         ///< readings a second, Hz; 0: in lockstep
  double seconds = std::numeric_limits<double>::infinity();  ///< simulated, from the first command on
  double legs = 0.0;                                         ///< m, as in GroundContact
  std::vector<std::size_t> rotor_of_output;
  bool record = false;                                       ///< keep a log of what is flown
  std::function<bool()> stop;                                ///< asked often; true ends
  std::function<void(const Readings&)> listening, progress;  ///< told once it listens; after each step
};

/// What was served.
struct Served {
  double seconds = 0.0;  ///< simulated since the first command, over all starts
  std::size_t frames = 0, repeated = 0, restarts = 0, lost = 0;
  std::map<std::string, std::size_t> refused;  ///< datagrams by what was wrong with them
  double late = 0.0;  ///< s that the clock was ahead of the simulation and was not caught up
  Readings last;
  FlightLog log;  ///< since the last start
};

class Server {
 public:
  /// Opens the port; throws UsageError as UdpSocket and ServedVehicle do.
  Server(const Autopilot& autopilot, const Vehicle& vehicle, const ServeOptions& options);

  std::uint16_t port() const { return socket_.port(); }
  /// Serves until `seconds` are over or `stop` says so.
  Served run();

 private:
  void lockstep();
  void against_the_clock();
  bool ended() const;
  void answer(const Datagram& datagram);
  void take(const Datagram& datagram);
  bool accepted(const Commands& commands);
  std::vector<double> delta(const Commands& commands) const;
  void restart();
  void step(double seconds);

  const Autopilot* autopilot_;
  ServeOptions options_;
  UdpSocket socket_;
  ServedVehicle vehicle_;
  CommandRange range_;
  std::optional<std::uint32_t> frame_;
  std::vector<double> delta_;
  std::uint32_t peer_;  ///< address of the autopilot, once heard
  std::string answer_;
  bool heard_ = false;
  double silence_ = 0.0;  ///< s since the last commands, against the clock
  Served served_;
};

}  // namespace ident
