// Speaks the Chrome DevTools Protocol: JSON messages, each ended by a NUL byte, on file descriptors 3 and 4.
#include "support/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "ident/result/result.h"

namespace ident::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kProgram = "/usr/bin/chromium";
constexpr int kPatience = 60'000;  // ms for one answer, on a busy machine

[[noreturn]] void run_chromium(int input, int output, const std::string& profile) {
  ::setpgid(0, 0);
  // Out of the way first, so that neither is overwritten by the other.
  const int in = ::fcntl(input, F_DUPFD, 10), out = ::fcntl(output, F_DUPFD, 10);
  ::dup2(in, 3);
  ::dup2(out, 4);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, fd);
  const std::string profile_option = "--user-data-dir=" + profile;
  ::execl(kProgram, kProgram, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
          "--disable-background-networking", "--disable-component-update", "--disable-sync",
          "--disable-dev-shm-usage", "--remote-debugging-pipe", profile_option.c_str(), "about:blank",
          static_cast<char*>(nullptr));
  ::_exit(127);
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    unsigned digit = 0;
    if (c >= 'A' && c <= 'Z')
      digit = static_cast<unsigned>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      digit = static_cast<unsigned>(c - 'a') + 26;
    else if (c >= '0' && c <= '9')
      digit = static_cast<unsigned>(c - '0') + 52;
    else if (c == '+')
      digit = 62;
    else if (c == '/')
      digit = 63;
    else
      break;
    group = (group << 6) | digit;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>((group >> bits) & 0xFFU);
  }
  return bytes;
}

}  // namespace

bool Browser::available() { return fs::exists(kProgram); }

Browser::Browser() {
  std::string pattern = (fs::temp_directory_path() / "ident-browser-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for the browser's profile");
  profile_ = pattern;
  std::array<int, 2> commands{}, answers{};
  if (::pipe2(commands.data(), O_CLOEXEC) != 0 || ::pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe to the browser");
  process_ = ::fork();
  if (process_ == 0) run_chromium(commands[0], answers[1], profile_);
  ::close(commands[0]);
  ::close(answers[1]);
  to_browser_ = commands[1];
  from_browser_ = answers[0];

  const std::string target = call("Target.createTarget", {{"url", "about:blank"}}).at("targetId");
  session_ = call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}}).at("sessionId");
  call("Performance.enable", {{"timeDomain", "threadTicks"}});
  for (const char* domain : {"Page.enable", "Runtime.enable", "Log.enable", "Network.enable"}) call(domain);
  set_window(1300, 900);
}

Browser::~Browser() {
  ::close(to_browser_);
  ::close(from_browser_);
  ::kill(-process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  std::error_code ignored;
  fs::remove_all(profile_, ignored);
}

json Browser::receive() {
  std::size_t end = 0;
  while ((end = buffer_.find('\0')) == std::string::npos) {
    pollfd ready{.fd = from_browser_, .events = POLLIN, .revents = 0};
    std::array<char, 65536> chunk{};
    const ssize_t count =
        ::poll(&ready, 1, kPatience) > 0 ? ::read(from_browser_, chunk.data(), chunk.size()) : -1;
    if (count <= 0) throw std::runtime_error("the browser does not answer");
    buffer_.append(chunk.data(), static_cast<std::size_t>(count));
  }
  json message = json::parse(buffer_.substr(0, end));
  buffer_.erase(0, end + 1);
  if (message.contains("method")) note_error(message);
  return message;
}

void Browser::note_error(const json& event) {
  const std::string method = event.at("method");
  if (method == "Page.loadEventFired") loaded_ = true;
  const bool failed = method == "Runtime.exceptionThrown" || method == "Network.loadingFailed" ||
                      (method == "Runtime.consoleAPICalled" && event.at("params").at("type") == "error") ||
                      (method == "Log.entryAdded" && event.at("params").at("entry").at("level") == "error");
  if (failed) errors_.push_back(event.dump());
}

json Browser::call(const std::string& method, const json& parameters) {
  json message{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump();
  for (std::size_t sent = 0; sent <= text.size();) {
    const ssize_t count = ::write(to_browser_, text.c_str() + sent, text.size() + 1 - sent);
    if (count <= 0) throw std::runtime_error("the browser has gone");
    sent += static_cast<std::size_t>(count);
  }
  for (;;) {
    const json answer = receive();
    if (answer.value("id", 0) != last_id_) continue;
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer.at("error").dump());
    return answer.at("result");
  }
}

void Browser::set_window(int width, int height, bool dark) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  const json scheme{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
  call("Emulation.setEmulatedMedia", {{"features", json::array({scheme})}});
}

void Browser::open(const std::string& path) {
  errors_.clear();
  loaded_ = false;
  call("Page.navigate", {{"url", "file://" + fs::absolute(path).string()}});
  while (!loaded_) receive();
}

json Browser::evaluate(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) throw std::runtime_error(answer.at("exceptionDetails").dump());
  return answer.at("result").value("value", json());
}

void Browser::mouse(const char* type, double x, double y, bool pressed) {
  call("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", x},
                                    {"y", y},
                                    {"button", pressed ? "left" : "none"},
                                    {"buttons", pressed ? 1 : 0},
                                    {"clickCount", pressed ? 1 : 0}});
}

void Browser::move_mouse(double x, double y) { mouse("mouseMoved", x, y, false); }

void Browser::click(double x, double y) {
  move_mouse(x, y);
  mouse("mousePressed", x, y, true);
  mouse("mouseReleased", x, y, true);
}

void Browser::drag(double from_x, double to_x, double y) {
  move_mouse(from_x, y);
  mouse("mousePressed", from_x, y, true);
  mouse("mouseMoved", (from_x + to_x) / 2, y, true);
  mouse("mouseMoved", to_x, y, true);
  mouse("mouseReleased", to_x, y, true);
}

double Browser::busy_seconds() {
  const json metrics = call("Performance.getMetrics").at("metrics");
  for (const json& metric : metrics)
    if (metric.at("name") == "TaskDuration") return metric.at("value");
  throw std::runtime_error("the browser counts no processor time");
}

std::string Browser::print() {
  const json answer = call(
      "Page.printToPDF",
      {{"paperWidth", 8.27}, {"paperHeight", 11.69}, {"preferCSSPageSize", true}, {"printBackground", true}});
  return from_base64(answer.at("data"));
}

}  // namespace ident::testing
