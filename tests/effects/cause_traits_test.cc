// Traits of causes name nothing that does not exist.
#include "ident/effects/cause_traits.h"

#include <gtest/gtest.h>

#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

bool is_cause(std::string_view name) {
  constexpr std::string_view kValue = "parameter:";
  if (name.starts_with(kValue)) return find_parameter(std::string(name.substr(kValue.size()))) != nullptr;
  return find_effect(name) != nullptr;
}

TEST(CauseTraits, EveryNameIsAnEffectOrAConstant) {
  for (const CauseTraits& one : all_cause_traits()) {
    EXPECT_TRUE(is_cause(one.name)) << one.name;
    for (const std::string_view other : one.implies)
      EXPECT_TRUE(is_cause(other)) << one.name << " and " << other;
    EXPECT_TRUE(one.alias_of.empty() || is_cause(one.alias_of)) << one.name;
  }
}

TEST(CauseTraits, ACauseWithoutTraitsHasNone) {
  EXPECT_FALSE(traits_of("translational_lift").moves_mass);
  EXPECT_TRUE(traits_of("payload").bolted_on);
  EXPECT_TRUE(implies("payload", "cg_offset"));
  EXPECT_FALSE(implies("cg_offset", "payload"));
}

}  // namespace
}  // namespace ident
