// POSIX sockets: bind, wait, receive, send.
#include "ident/fly/udp_socket.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "ident/core/error.h"

namespace ident {
namespace {

constexpr std::size_t kLongest = 65536;  // bytes, more than any datagram has

sockaddr_in socket_address(const Endpoint& endpoint) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_addr.s_addr = htonl(endpoint.address);
  out.sin_port = htons(endpoint.port);
  return out;
}

[[noreturn]] void refuse_port(const std::string& address, std::uint16_t port, int error) {
  if (error == EADDRINUSE)
    throw UsageError(
        fmt::format("port {} of {} is taken: another program listens there. End it, or choose a port "
                    "with --port",
                    port, address));
  throw UsageError(fmt::format("port {} of {} cannot be opened: {}", port, address, std::strerror(error)));
}

}  // namespace

std::uint32_t ipv4_address(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1)
    throw UsageError(fmt::format("'{}' is no IPv4 address such as 127.0.0.1", text));
  return ntohl(address.s_addr);
}

UdpSocket::UdpSocket(const std::string& address, std::uint16_t port) {
  sockaddr_in own = socket_address({ipv4_address(address), port});
  descriptor_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0) refuse_port(address, port, errno);
  if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
    const int error = errno;
    ::close(descriptor_);
    refuse_port(address, port, error);
  }
  socklen_t size = sizeof own;
  ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&own), &size);
  port_ = ntohs(own.sin_port);
}

UdpSocket::~UdpSocket() { ::close(descriptor_); }

std::optional<Datagram> UdpSocket::receive(double wait) {
  pollfd readable{.fd = descriptor_, .events = POLLIN, .revents = 0};
  const double left = std::max(wait, 0.0);
  timespec time{};
  time.tv_sec = static_cast<time_t>(left);
  time.tv_nsec = static_cast<long>((left - std::floor(left)) * 1e9);
  if (::ppoll(&readable, 1, &time, nullptr) <= 0) return std::nullopt;
  std::array<char, kLongest> buffer;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const ssize_t length = ::recvfrom(descriptor_, buffer.data(), buffer.size(), MSG_DONTWAIT,
                                    reinterpret_cast<sockaddr*>(&from), &size);
  if (length < 0) return std::nullopt;
  return Datagram{{buffer.data(), static_cast<std::size_t>(length)},
                  {ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)}};
}

void UdpSocket::send(const Endpoint& to, const std::string& bytes) {
  const sockaddr_in address = socket_address(to);
  ::sendto(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
           reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

}  // namespace ident
