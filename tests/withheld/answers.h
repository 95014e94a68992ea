// The truth of a case and the answer of a diagnosis, read back from their files.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace withheld {

using Names = std::set<std::string>;

struct TrueEffect {
  std::string name, form;
  double over_limit = 0, over_limit_joint = 0;
  std::map<std::string, double> parameters;
};

struct Truth {
  int index = 0;
  std::string kind;                 // none, single, pair, outside
  std::vector<TrueEffect> effects;  // of the catalogue, or wrong parameters
  std::optional<TrueEffect> outside;
  Names accompanying;               // truly there, too, but not what was drawn
  double left_by_look_alike = 1e9;  // size over limit that the best other effect leaves unexplained
  bool rotor_speeds = true;

  Names names() const;
};

struct Estimate {
  double value = 0, std = 0;
};

struct Candidate {
  std::optional<double> probability, closed;
  std::map<std::string, Estimate> parameters;
  std::map<std::string, double> detection_limit;
};

struct Answer {
  bool given = false;  // a readable verdict, exit status 0
  std::string status;
  // Causes are named, whatever else is said to be left.
  bool names_causes() const { return status == "identified" || status == "partly"; }
  Names effects, confused_with;
  std::map<std::string, Candidate> candidates;
  std::optional<double> closed;
  double seconds = 0;
};

struct Scored {
  Truth truth;
  Answer answer;
  std::optional<Answer> excluded;  // with the truth taken out of the catalogue
};

// All cases of a campaign with the answers of one folder; `half` is odd, even or all.
std::vector<Scored> read_campaign(const std::string& folder, const std::string& answers,
                                  const std::string& half);

}  // namespace withheld
