// A headless Chromium, driven over its debugging pipe: opens pages, runs expressions, moves the mouse,
// prints.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident::testing {

class Browser {
 public:
  /// Whether Chromium is installed; tests skip without it.
  static bool available();

  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Window and colour scheme of the pages opened from now on.
  void set_window(int width, int height, bool dark = false);
  /// Opens a file and waits until it has loaded. Forgets the errors of earlier pages.
  void open(const std::string& path);
  /// Value of a JavaScript expression; a promise is waited for.
  nlohmann::json evaluate(const std::string& expression);
  void move_mouse(double x, double y);
  void click(double x, double y);
  void drag(double from_x, double to_x, double y);
  /// Processor time that the page has taken since it was opened, s: what other work on the machine costs is
  /// not in it.
  double busy_seconds();
  /// The page on A4, as the bytes of a PDF.
  std::string print();
  /// Console errors, failed requests and uncaught exceptions of the page.
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  void mouse(const char* type, double x, double y, bool pressed);
  nlohmann::json receive();
  void note_error(const nlohmann::json& event);

  int process_ = -1, to_browser_ = -1, from_browser_ = -1, last_id_ = 0;
  std::string profile_, session_, buffer_;
  bool loaded_ = false;
  std::vector<std::string> errors_;
};

}  // namespace ident::testing
