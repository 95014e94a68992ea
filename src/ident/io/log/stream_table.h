// The signals of a log of streams on one axis of time, as the reader of flight logs takes them.
#pragma once

#include "ident/data/log_streams.h"
#include "ident/data/table.h"
#include "ident/io/log/log_columns.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/model/vehicle.h"

namespace ident {

struct StreamTable {
  NumberTable table;  ///< a row for each instant at which anything was sampled
  LogColumns columns;
  LogMap map;                 ///< with the windows in which the vehicle flies, where the map states none
  double loop = 0.0;          ///< s, of the controller; 0: not stated
  bool each_command = false;  ///< the log has each of its commands
  Vehicle vehicle;  ///< with the range of commands that the log states, where it has none of its own
};

/// Throws InputError where the log lacks what a flight log needs or drives more motors than the vehicle has,
/// and DataError where the vehicle never flew.
StreamTable make_stream_table(const LogStreams& log, const Vehicle& vehicle, const LogMap& map,
                              LogContent content = LogContent::flight);

}  // namespace ident
