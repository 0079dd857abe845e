// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdlib>
#include <set>

#include "program/sums_signature.hpp"
#include "sandbox.hpp"

namespace fs = std::filesystem;

namespace {

class Deploy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "clean", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "fit"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }
  void TearDown() override { fs::remove_all(box->path() / "out"); }

  static bool sums_hold(const std::string& folder) {
    const std::string command =
        "cd '" + (box->path() / folder).string() + "' && sha256sum --quiet -c SHA256SUMS 2>&1";
    return std::system(command.c_str()) == 0;
  }
  static Sandbox* box;
};
Sandbox* Deploy::box = nullptr;

TEST_F(Deploy, WritesAllThatPlumbRtNeeds) {
  const Ran ran = box->plumb({"-C", "cell", "deploy", "-o", "out/cell4"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(box->path() / "out/cell4"))
    names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"SHA256SUMS", "bus.dbc", "modbus-map.md", "robot.plumb",
                                          "rt.toml"}));
  EXPECT_EQ(std::distance(fs::directory_iterator(box->path() / "out"), {}), 1);  // no draft
  EXPECT_EQ(box->plumb({"inspect", "out/cell4/robot.plumb"}).exit, 0);
  EXPECT_EQ(box->read("out/cell4/bus.dbc"), box->plumb({"-C", "cell", "dbc"}).out);
  EXPECT_EQ(box->read("out/cell4/modbus-map.md"), box->plumb({"-C", "cell", "modbus-map"}).out);
}

plumb::PublicKey public_key(const Sandbox& box, const std::string& file) {
  return plumb::read_public_key(box.read(file));
}

TEST_F(Deploy, AKeySignsTheWholeFolder) {
  ASSERT_EQ(box->plumb({"keygen", "anna"}).exit, 0);
  ASSERT_EQ(box->plumb({"keygen", "berta"}).exit, 0);
  const Ran ran = box->plumb({"-C", "cell", "deploy", "-o", "out", "--sign", "anna.key", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto anna = public_key(*box, "anna.pub"), berta = public_key(*box, "berta.pub");
  EXPECT_EQ(ran.json().at("result").at("key_id"), anna.id());
  const auto signature = plumb::read_signature(box->read("out/SHA256SUMS.sig"));
  EXPECT_TRUE(plumb::signs(signature, anna, box->read("out/SHA256SUMS")));
  EXPECT_FALSE(plumb::signs(signature, anna, box->read("out/SHA256SUMS") + "\n"));
  EXPECT_FALSE(plumb::signs(signature, berta, box->read("out/SHA256SUMS")));
  EXPECT_NE(box->read("out/rt.toml").find("\nmade = \"20"), std::string::npos);
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out", "--force"}).exit, 0);
  EXPECT_FALSE(fs::exists(box->path() / "out/SHA256SUMS.sig")) << "an old signature is not left";
}

TEST_F(Deploy, AKeyIsNeverReplacedAndAPrivateOneIsPrivate) {
  ASSERT_EQ(box->plumb({"keygen", "carla"}).exit, 0);
  const std::string key = box->read("carla.key");
  for (const char* const gone : {"carla.pub", "carla.key"}) {
    const Ran again = box->plumb({"keygen", "carla"});
    EXPECT_EQ(again.exit, 2);
    EXPECT_NE(again.err.find("error[E-EXISTS]"), std::string::npos) << again.err;
    EXPECT_EQ(box->read("carla.key"), key);
    fs::rename(box->path() / gone, box->path() / (std::string(gone) + ".aside"));
    EXPECT_EQ(box->plumb({"keygen", "carla"}).exit, 2) << "half a pair is there";
    fs::rename(box->path() / (std::string(gone) + ".aside"), box->path() / gone);
  }
  struct stat found {};
  ASSERT_EQ(::stat((box->path() / "carla.key").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600U);
  const auto sign = [&](const std::string& file) {
    return box->plumb({"-C", "cell", "deploy", "-o", "out", "--sign", file});
  };
  for (const mode_t mode : {0640, 0604, 0666, 0620}) {
    ASSERT_EQ(::chmod((box->path() / "carla.key").c_str(), mode), 0);
    const Ran open = sign("carla.key");
    EXPECT_EQ(open.exit, 3);
    EXPECT_NE(open.err.find("error[E-KEY-RIGHTS]"), std::string::npos) << open.err;
  }
  ASSERT_EQ(::chmod((box->path() / "carla.pub").c_str(), 0600), 0);
  EXPECT_NE(sign("carla.pub").err.find("error[E-KEY]"), std::string::npos);
  EXPECT_NE(sign("none.key").err.find("error[E-READ]"), std::string::npos);
  EXPECT_EQ(box->plumb({"keygen", "nowhere/x"}).exit, 5);
  EXPECT_FALSE(fs::exists(box->path() / "out")) << "nothing was written";
}

TEST_F(Deploy, TheSumsHoldAndBreakWithAByte) {
  ASSERT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out"}).exit, 0);
  EXPECT_TRUE(sums_hold("out"));
  box->write("out/bus.dbc", box->read("out/bus.dbc") + " ");
  EXPECT_FALSE(sums_hold("out"));
}

TEST_F(Deploy, TheModelIsTheOneThatCompileMakes) {
  ASSERT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out"}).exit, 0);
  ASSERT_EQ(box->plumb({"-C", "cell", "compile", "-o", "same.plumb", "--force"}).exit, 0);
  EXPECT_EQ(box->read("out/robot.plumb"), box->read("same.plumb"));
}

TEST_F(Deploy, TheConfigurationSaysEverythingAndStartsInShadow) {
  ASSERT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out"}).exit, 0);
  const std::string toml = box->read("out/rt.toml");
  for (const char* line :
       {"schema = \"rt/1\"", "file = \"robot.plumb\"", "cycle_us = 4000", "kind = \"can\"",
        "interface = \"can0\"", "mode = \"shadow\"", "poses = 50", "position_um = 50",
        "rotation_urad = 50", "can_format = \"classic\"", "[bus.target]", "can_id = 0x118"})
    EXPECT_NE(("\n" + toml).find("\n" + std::string(line)), std::string::npos) << line;
}

TEST_F(Deploy, TheModeIsThatOfTheOptionAndIsSaid) {
  for (const std::string mode : {"limited", "full"}) {
    const Ran ran = box->plumb({"-C", "cell", "deploy", "-o", "out", "--mode", mode, "--force"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_NE(box->read("out/rt.toml").find("\nmode = \"" + mode + "\""), std::string::npos);
    EXPECT_NE(ran.out.find("Mode " + mode + ":"), std::string::npos) << ran.out;
  }
  const auto result =
      box->plumb({"-C", "cell", "deploy", "-o", "out", "--force", "--json"}).json().at("result");
  EXPECT_EQ(result.at("mode"), "shadow");
  EXPECT_GT(result.at("max_correction_mm"), 0.0);
  EXPECT_LE(result.at("audit").at("refused_pct"), 5.0);
  EXPECT_GT(result.at("cost").at("instructions"), 10'000.0);
  EXPECT_GT(result.at("cost").at("worst_us"), 0.0);
  EXPECT_NE(box->read("out/rt.toml").find("\nmode = \"shadow\""), std::string::npos);
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out", "--mode", "off", "--force"}).exit, 2);
}

TEST_F(Deploy, NothingIsReplacedWithoutForceAndOtherFilesStay) {
  ASSERT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out"}).exit, 0);
  box->write("out/rt.toml", "edited");
  box->write("out/record.log", "precious");
  const Ran refused = box->plumb({"-C", "cell", "deploy", "-o", "out"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("error[E-EXISTS]"), std::string::npos);
  EXPECT_EQ(box->read("out/rt.toml"), "edited");
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out/", "--force"}).exit, 0);
  EXPECT_NE(box->read("out/rt.toml"), "edited");
  EXPECT_EQ(box->read("out/record.log"), "precious");
  EXPECT_TRUE(sums_hold("out"));
}

TEST_F(Deploy, AFolderIsThereWholeOrNotAtAll) {
  box->write("file", "");
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "file"}).exit, 2);
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "file/out"}).exit, 5);
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out", "--dry-run"}).exit, 0);
  EXPECT_FALSE(fs::exists(box->path() / "out"));
}

TEST_F(Deploy, AGateThatFailsWritesNothing) {
  const std::string cell = box->read("cell/cell.toml");
  box->write("cell/cell.toml", cell.substr(0, cell.find("tolerance_mm")) + "tolerance_mm = 1e-6" +
                                   cell.substr(cell.find('\n', cell.find("tolerance_mm"))));
  EXPECT_EQ(box->plumb({"-C", "cell", "deploy", "-o", "out", "--gate"}).exit, 1);
  EXPECT_FALSE(fs::exists(box->path() / "out"));
  box->write("cell/cell.toml", cell);
}

TEST_F(Deploy, JsonNamesTheNumbersThatTheControllerSends) {
  const auto result =
      box->plumb({"-C", "cell", "deploy", "-o", "out", "--json"}).json().at("result");
  EXPECT_EQ(result.at("files").size(), 5U);
  EXPECT_GT(result.at("robot_number"), 0);
  EXPECT_GT(result.at("model_number"), 0);
  EXPECT_LT(result.at("worst_bus_load_pct"), 70.0);
}

}  // namespace
