// A UDP socket over IPv4 that is bound to one address: datagrams come and go.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ident {

/// Where a datagram comes from or goes to: IPv4 address and port in the machine's byte order.
struct Endpoint {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
};

/// Address "a.b.c.d" as a number; throws UsageError where it is none.
std::uint32_t ipv4_address(const std::string& text);

struct Datagram {
  std::string bytes;
  Endpoint from;
};

class UdpSocket {
 public:
  /// Port 0 takes a free one. Throws UsageError where the port is taken or the address is not one of this
  /// machine.
  UdpSocket(const std::string& address, std::uint16_t port);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  std::uint16_t port() const { return port_; }
  /// The next datagram, after at most `wait` seconds; nothing when none came or a signal did.
  std::optional<Datagram> receive(double wait);
  /// What cannot be sent is lost, as datagrams are.
  void send(const Endpoint& to, const std::string& bytes);

 private:
  int descriptor_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace ident
