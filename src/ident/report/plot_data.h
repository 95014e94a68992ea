// The data of interactive time series as one script in the page: vectors once each, as base64 float32.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// Collects the time series of a page.
class PlotData {
 public:
  /// Adds a plot; cursors and zoom are shared by the plots of one `group`. Returns its number on the page.
  int add(const Plot& plot, const std::string& group);
  bool empty() const { return plots_.empty(); }

  /// JSON that is safe inside a script element.
  std::string json() const;

 private:
  /// Index of the vector among those of the page, less `origin`, which float32 could not resolve.
  std::size_t store(const std::vector<double>& values, double origin);

  std::vector<std::string> arrays_;
  std::map<std::string, std::size_t> known_;
  nlohmann::ordered_json plots_ = nlohmann::ordered_json::array();
};

/// RFC 4648 with padding.
std::string base64(const std::string& bytes);

}  // namespace ident
