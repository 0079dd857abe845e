// SPDX-License-Identifier: Apache-2.0
#include "cell/fleet_priors.hpp"

#include <cmath>

#include "support.hpp"

namespace plumb::offline {
namespace {

const std::string kCell =
    "schema = \"cell/1\"\n"
    "[robot]\n"
    "dh_convention = \"standard\"\n"
    "joints = [{ name = \"J1\", a = 100, q = [-90, 90] }, { name = \"J2\", q = [-90, 90] }]\n"
    "[fit]\n"
    "prior_from = \"fleet.json\"\n";

/// A fleet file with one model.
std::string fleet(const std::string& key, const std::string& typical,
                  const std::string& shares = "") {
  return "{\"schema\": \"fleet/1\", \"models\": [{\"key\": \"" + key + "\", \"typical\": [" +
         typical + "], \"shares\": [" + shares + "]}]}";
}

std::string number(const std::string& name, const std::string& mean, const std::string& sd) {
  return "{\"name\": \"" + name + "\", \"mean_si\": " + mean + ", \"sd_si\": " + sd + "}";
}

class FleetPriors : public testing::Test {
 protected:
  FleetPriors() {
    folder.put("other.toml", kCell.substr(0, kCell.find("[fit]")));
    key = model_key(read_cell(folder.path() / "other.toml").nominal);
  }
  Cell read(const std::string& json, const std::string& more = "") {
    folder.put("fleet.json", json);
    return read_cell(folder.put("cell.toml", kCell + more));
  }
  Summary refused(const std::string& json) {
    return summary(problems_of([&] { read(json); }));
  }

  Folder folder;
  std::string key;
};

TEST_F(FleetPriors, AreTakenOver) {
  const Cell cell = read(fleet(key, number("J1.a", "1e-4", "5e-5"),
                               "{\"effect\": \"joint_compliance\", \"odds_nats\": 2.5}"));
  ASSERT_EQ(cell.fit.priors.size(), 1u);
  EXPECT_EQ(cell.fit.priors[0].name, "J1.a");
  EXPECT_EQ(cell.fit.priors[0].mean, 1e-4);
  EXPECT_EQ(cell.fit.priors[0].sigma, 5e-5);
  EXPECT_TRUE(cell.fit.priors[0].of_fleet);
  ASSERT_EQ(cell.fit.sister_odds.size(), 1u);
  EXPECT_EQ(cell.fit.sister_odds[0].nats, 2.5);
}

TEST_F(FleetPriors, OfWhatTheCellStatesItselfAreLeftOut) {
  const Cell cell =
      read(fleet(key, number("J1.a", "1e-4", "5e-5")), "prior = { \"J1.a\" = 0.2 }\n");
  ASSERT_EQ(cell.fit.priors.size(), 1u);
  EXPECT_FALSE(cell.fit.priors[0].of_fleet);
  EXPECT_DOUBLE_EQ(cell.fit.priors[0].sigma, 0.2e-3);
}

TEST_F(FleetPriors, ChangeTheHashOfTheCell) {
  const std::string one = hash_of(read(fleet(key, number("J1.a", "1e-4", "5e-5"))));
  EXPECT_NE(hash_of(read(fleet(key, number("J1.a", "1e-4", "6e-5")))), one);
  EXPECT_EQ(hash_of(read(fleet(key, number("J1.a", "1e-4", "5e-5")))), one);
}

TEST_F(FleetPriors, AreWrittenAsTheFileThatTheyComeFrom) {
  const Cell cell = read(fleet(key, number("J1.a", "1e-4", "5e-5")));
  const std::string text = write_cell(cell);
  EXPECT_NE(text.find("prior_from = \"fleet.json\""), std::string::npos) << text;
  EXPECT_EQ(text.find("prior = "), std::string::npos) << text;
}

TEST_F(FleetPriors, OfTooFewArmsAreNone) {
  const Cell cell = read(fleet(key, ""));
  EXPECT_TRUE(cell.fit.priors.empty());
  EXPECT_EQ(summary(cell.remarks), Summary{"W-CELL-PRIOR 6:14"});
}

TEST_F(FleetPriors, OfAnotherModelOrADamagedFileAreRefused) {
  const Summary prior{"E-CELL-PRIOR 6:14"};
  EXPECT_EQ(refused(fleet("0123456789ab", number("J1.a", "0", "1"))), prior);
  EXPECT_EQ(refused("{\"schema\": \"fleet/2\", \"models\": []}"), prior);
  EXPECT_EQ(refused("{\"schema\": \"fleet/1\""), prior);
  EXPECT_EQ(refused(""), prior);
  for (const char* sd : {"0", "-1e-5", "1e300", "null", "\"x\""})
    EXPECT_EQ(refused(fleet(key, number("J1.a", "0", sd))), prior) << sd;
  EXPECT_EQ(refused(fleet(key, number("J1.a", "1e300", "1e-5"))), prior);
  EXPECT_EQ(problems_of([&] {
              read_cell(folder.put("cell.toml",
                                   kCell.substr(0, kCell.find("fleet.json")) + "none.json\"\n"));
            }).size(),
            1u);
}

}  // namespace
}  // namespace plumb::offline
