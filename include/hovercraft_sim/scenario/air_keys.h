#pragma once

#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/key_table.h"
#include "hovercraft_sim/scenario/scenario_names.h"

/// The keys of gusts (key_table.h).

namespace hovercraft {

inline constexpr NumberRule kSigma = {[](double x) { return x >= 0.0 && x <= kFastestWind; },
                                      "must be 0 to 1e6"};

/// Of a GustAxis.
inline constexpr auto kGustAxisKeys = [](auto& axis, auto&& visit) {
  visit(NumberKey("sigma", "m/s", kSigma), axis.sigma);
  visit(LengthKey("length", "m"), axis.length);
};

/// Of GustParameters; an axis without gusts has the length 0.
inline constexpr auto kGustKeys = [](auto& gusts, auto&& visit) {
  const auto axis = [&visit](const char* name, auto& value) {
    visit(optional(writtenIf(value.length != 0.0, MapKey(name, kGustAxisKeys))), value);
  };
  visit(optional(ChoiceKey("model", gustModelNames())), gusts.model);
  axis("along", gusts.along);
  axis("across", gusts.across);
  axis("vertical", gusts.vertical);
};

}  // namespace hovercraft
