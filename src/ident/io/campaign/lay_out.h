// The campaign of a folder, from whatever logs, bench files and vehicle files lie in it.
#pragma once

#include <string>
#include <vector>

#include "ident/io/campaign/campaign.h"
#include "ident/io/campaign/recognise_file.h"

namespace ident {

struct LaidOutCampaign {
  Campaign campaign;    ///< paths as opened from here
  std::string text;     ///< of ident.yaml
  std::string drafted;  ///< of the vehicle file; empty where one lies there
  std::vector<FoundFile> taken, left;
  std::vector<std::string> fill_in;     ///< what the vehicle file guesses or does not state
  std::vector<std::string> now, later;  ///< commands that can run, and that can once that is filled in
  std::vector<std::string> notices;
  std::vector<Warning> warnings;
};

/// Every file is read as the commands will, and left alone where they could not, or where another one has the
/// same bytes. The vehicle file is the one named, or as choose_vehicle() finds it. Throws InputError where
/// ident.yaml or the file that would be drafted is there already, UsageError where several vehicles lie
/// there, DataError where there is nothing to work with.
LaidOutCampaign lay_out_campaign(const std::string& folder, const std::string& vehicle = "");

}  // namespace ident
