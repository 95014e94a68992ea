// The vehicle file of a campaign that is laid out: one that lies there, or a draft.
#pragma once

#include <string>
#include <vector>

#include "ident/io/campaign/recognise_file.h"
#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

struct ChosenVehicle {
  std::string file;     ///< as opened from here
  std::string drafted;  ///< its text where it is still to be written
  Vehicle vehicle;
  std::vector<std::string> fill_in;  ///< guesses of a draft that a user knows better
  std::vector<std::string> notices;
  std::vector<Warning> warnings;  ///< logs of another frame than the one drafted
};

/// The file `named`, else the one vehicle file among `files`, else the one simulator's file, else a draft:
/// from the logs of autopilots that state where motors sit, or with nothing but what is to be filled in. A
/// simulator's file that cannot be read becomes one of another kind in `files`. Throws UsageError where
/// several vehicles lie there.
ChosenVehicle choose_vehicle(const std::string& folder, std::vector<FoundFile>& files,
                             const std::string& named);

}  // namespace ident
