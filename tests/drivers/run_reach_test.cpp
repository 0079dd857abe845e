// SPDX-License-Identifier: Apache-2.0
// A model whose numbers do not fit into those of the bus is refused, when plumb-rt starts and when
// it runs.
#include <gtest/gtest.h>

#include "rt/model_swap.hpp"
#include "rt/service.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/in_memory_port.hpp"
#include "tests/drivers/rt_program.hpp"
#include "tests/rt/warm_arm.hpp"

namespace plumb::tests {
namespace {

using namespace drivers;

const std::string kOffsets =
    "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"can\"\ninterface = \"nocan9\"\n"
    "[bus]\ncorrection = \"offset\"\n";

/// Corrections of 5 mm, where an offset of a classic frame reaches 3.2767 mm.
format::Model with_large_corrections() {
  format::Model out = Deployed::arm();
  out.guard.max_correction_m = 0.005;
  return out;
}

/// Joints of 10 rad, where a count of 24 bits reaches 8.388607 rad.
format::Model with_wide_joints() {
  format::Model out = Deployed::arm();
  out.nominal.joints[5].q_max = 10.0;
  return out;
}

class MemoryBus final : public rt::OpenBus {
 public:
  BusPort& port() noexcept override { return port_; }

 private:
  InMemoryPort port_;
};

RtRan start(const Deployed& folder) {
  return plumb_rt({"run", folder.folder.string()}, folder.folder);
}

TEST(RunReach, AModelThatTheBusCutsOffIsRefusedWhenItIsLoaded) {
  const Deployed folder(kOffsets);
  EXPECT_NE(start(folder).err.find("error[E-RT-LINK]"), std::string::npos) << "it fits as it is";
  folder.write_model("robot.plumb", with_large_corrections());
  RtRan ran = start(folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("error[E-RT-BUS]: an offset reaches 3.277 mm, but a correction 5 mm"),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("= help: [bus.offset] count_um = 0.2"), std::string::npos) << ran.err;
  folder.write("rt.toml", kOffsets + "[bus.offset]\ncount_um = 0.2\n");
  EXPECT_EQ(start(folder).exit, 5) << "the help helps: only the interface is missing";
  folder.write_model("robot.plumb", with_wide_joints());
  ran = start(folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("q6 of joints reaches 8.389 rad, but the joint 10 rad"), std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("= help: [bus.joints] count_urad = 1.2"), std::string::npos) << ran.err;
}

TEST(RunReach, ModbusAndCanFdHaveRoomForAll) {
  const Deployed folder(kOffsets + "can_format = \"fd\"\n");
  folder.write_model("robot.plumb", with_large_corrections());
  EXPECT_EQ(start(folder).exit, 5);
  std::string toml = kOffsets;
  toml.replace(toml.find("\"can\"\ninterface = \"nocan9\""), 26, "\"modbus\"\naddress = \"x y\"");
  folder.write("rt.toml", toml);
  EXPECT_EQ(start(folder).exit, 5);
}

/// All of a plumb-rt that runs from the folder except the cycle: no model that is handed over is
/// ever taken.
class Running {
 public:
  explicit Running(const Deployed& folder)
      : folder_(folder.folder), deployment_(rt::load_deployment(folder.folder)) {
    service_.start();
  }

  RtRan swap(const std::string& file) const {
    return plumb_rt({"swap", (folder_ / file).string(), "--dir", folder_.string()}, folder_);
  }
  /// Whether a swap has handed a model to the cycle.
  bool published() const { return !slot_.settled(); }

 private:
  std::filesystem::path folder_;
  rt::Deployment deployment_;
  ModelSlot slot_{*deployment_.model.loaded};
  MemoryBus bus_;
  std::unique_ptr<RunShared> shared_ = std::make_unique<RunShared>();
  rt::Service service_{deployment_, bus_, slot_, *shared_, rt::Service::Files::kMade};
};

void expect_refused(const Running& running, const std::string& file, const std::string& why) {
  const RtRan ran = running.swap(file);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("error[E-RT-SWAP]"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
  EXPECT_FALSE(running.published());
}

TEST(RunReach, AModelThatTheBusCutsOffIsRefusedInASwap) {
  const Deployed folder(kOffsets);
  const Running running(folder);
  for (const auto& model : {with_large_corrections(), with_wide_joints()}) {
    folder.write_model("next.plumb", model);
    expect_refused(running, "next.plumb", "reaches");
  }
}

TEST(RunningModel, OfAnotherFileHasAnotherNumber) {
  const Deployed folder;
  folder.write_model("other.plumb", with_large_corrections());
  const auto number = [&](const char* name) {
    return rt::load_model(folder.folder / name, "").loaded->number();
  };
  EXPECT_NE(number("robot.plumb"), number("other.plumb"));
  EXPECT_EQ(number("robot.plumb"), number("robot.plumb"));
  EXPECT_LT(number("robot.plumb"), 1U << 23);
}

TEST(RunningModel, IsCalledByTheNameOfItsRobotOrElseByItsFile) {
  const Deployed folder;
  format::Model model = Deployed::arm();
  for (const char* name : {"", "UR10 of cell 4"}) {
    model.robot_name = name;
    folder.write_model("robot.plumb", model);
    const rt::Deployment deployment = rt::load_deployment(folder.folder);
    rt::RunFacts facts;
    rt::put_model(deployment, folder.folder / "robot.plumb", facts);
    EXPECT_EQ(facts.model_name, *name == '\0' ? "robot.plumb" : name);
    EXPECT_EQ(facts.model_sha256, sha256(read_file(folder.folder / "robot.plumb")));
  }
}

format::Model with_sensors(const std::vector<std::string>& names) {
  format::Model out = warm_arm(names);
  out.serial = Deployed::arm().serial;
  return out;
}

TEST(RunReach, ASensorThatTheBusDoesNotBringIsNamedBeforeTheCycleBegins) {
  const Deployed folder(Deployed::csv("[bus]\ntemperatures = [\"temp_room\"]\n"));
  folder.write_model("robot.plumb", with_sensors({"temp_arm", "temp_room"}));
  const RtRan ran = plumb_rt({"run", folder.folder.string(), "--check"}, folder.folder);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("warning[W-RT-SENSORS]: the model listens to temp_arm, which"),
            std::string::npos)
      << ran.err;
}

TEST(RunReach, ASwapMayReadTheSensorsOfTheModelBeforeAndNoOthersThatHaveAName) {
  const Deployed folder(kOffsets + "temperatures = [\"temp_room\", \"temp_arm\"]\n");
  folder.write_model("robot.plumb", with_sensors({"temp_arm"}));
  folder.write_model("more.plumb", with_sensors({"temp_arm", "temp_room"}));
  const Running running(folder);
  expect_refused(running, "more.plumb", "a sensor that the model before does not");
}

}  // namespace
}  // namespace plumb::tests
