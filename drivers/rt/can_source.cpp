// SPDX-License-Identifier: Apache-2.0
#include "rt/can_source.hpp"

#include <fmt/format.h>

#include "plumb/drivers/can_interface.hpp"
#include "plumb/drivers/can_port.hpp"
#include "rt/link_refusal.hpp"

namespace plumb::drivers::rt {
namespace {

class CanBus final : public OpenBus {
 public:
  explicit CanBus(CanPort port) : port_(std::move(port)) {}
  BusPort& port() noexcept override { return port_; }
  void tend() noexcept override { port_.recover(); }

 private:
  CanPort port_;
};

void refuse_misfit(const std::string& interface, const BusLayout& layout) {
  const auto found = read_can_interface(interface);
  if (!found) return;  // opening it says why
  for (const Finding& misfit : misfits(layout, *found))
    if (misfit.grant == Grant::kDenied)
      refuse_link(fmt::format("{}: {}", misfit.what, misfit.why), misfit.remedy);
}

}  // namespace

std::shared_ptr<const BusSource> CanSource::read(TomlTable& source, const std::filesystem::path&) {
  auto out = std::make_shared<CanSource>();
  out->interface = source.text_or("interface", out->interface);
  if (out->interface.empty() || out->interface.size() > 15)
    source.out_of_range("interface", "the name of a CAN interface, 1 to 15 characters");
  return out;
}

std::unique_ptr<OpenBus> CanSource::open(const BusTask& task) const {
  refuse_misfit(interface, task.layout);
  auto opening = CanPort::open(interface, task.layout, Sender::kPlumb);
  if (opening.port) return std::make_unique<CanBus>(std::move(*opening.port));
  const Finding finding = describe(opening.step);
  refuse_link(fmt::format("{}: {}", finding.what, finding.why), finding.remedy);
}

}  // namespace plumb::drivers::rt
