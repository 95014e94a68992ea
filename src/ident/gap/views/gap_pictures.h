// Pictures of a diagnosis: how far the gap closes, where it lies, what was tried, before and after.
#pragma once

#include "ident/gap/statistics/residual_wrench.h"
#include "ident/result/result.h"

namespace ident {

/// From the error of the model as given, by what the causes close, to what is left and the noise floor.
Plot waterfall_plot(const nlohmann::ordered_json& found, const std::string& causes);

/// From the whole gap, by the share that each cause named closes, to what is left; without series where no
/// share is known.
Plot shares_plot(const nlohmann::ordered_json& found);

/// Share of each channel and of each frequency band.
Plot channel_plot(const nlohmann::ordered_json& where);
Plot band_plot(const nlohmann::ordered_json& where);

/// Probabilities of the causes that have one worth showing; without series unless there are two to compare.
Plot probability_plot(const nlohmann::ordered_json& candidates);

/// Residual of a channel over the time of the first log, and over a regime variable; `after` may be the same
/// as `before`, which then is shown alone.
Plot residual_over_time(const ResidualWrench& before, const ResidualWrench& after, Eigen::Index channel);
Plot residual_over_regime(const ResidualWrench& before, const ResidualWrench& after, Eigen::Index channel,
                          const std::string& variable);

/// Unit of a channel of the residual, and of a regime variable.
std::string channel_unit(const std::string& channel);
std::string regime_unit(const std::string& variable);

/// "0.1 to 0.3 Hz".
std::string band_name(const nlohmann::ordered_json& band);

}  // namespace ident
