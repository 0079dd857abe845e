// SPDX-License-Identifier: Apache-2.0
#include "rt/firewall.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

#include "program/bounded_file.hpp"
#include "program/child.hpp"
#include "program/file.hpp"
#include "rt/place.hpp"
#include "rt/rt_config.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNft = "/usr/sbin/nft";
constexpr const char* kAskRoot = "sudo plumb-rt doctor";

constexpr std::pair<const char*, std::vector<std::string> FirewallRule::*> kChains[] = {
    {"output", &FirewallRule::output},
    {"input", &FirewallRule::input},
    {"forward", &FirewallRule::forward}};

std::string head(const std::string& table) {
  return fmt::format(
      "# Written by plumb-rt doctor --fix. plumb-rt@NAME loads it at every start; by hand: nft -f "
      "FILE\n"
      "# Root is kept out, too: sudo -u plumb plumb-rt run ... To take it away: nft delete table "
      "{0}\n"
      "table {0}\ndelete table {0}\ntable {0} {{\n",
      table);
}

std::string chain(const std::string& name, const std::string& hook, const std::string& lines) {
  return fmt::format("  chain {} {{\n    type filter hook {}\n{}  }}\n", name, hook, lines);
}

std::string lines_of(const FirewallRule& rule, const std::vector<std::string>& statements) {
  std::string out = statements.empty() ? "" : fmt::format("    # {}\n", rule.says);
  for (const std::string& one : statements) out += "    " + one + "\n";
  return out;
}

std::string can_text(const FirewallRule& rule) {
  const std::string hook =
      fmt::format("egress device \"{}\" priority filter; policy drop;", rule.can);
  return head(fmt::format("netdev plumb_{}", rule.can)) +
         chain("output", hook, lines_of(rule, rule.output)) + "}\n";
}

std::string tcp_text(const std::vector<FirewallRule>& rules) {
  std::string out = head("inet plumb_rt");
  for (const auto& [name, statements] : kChains) {
    std::string lines;
    for (const FirewallRule& rule : rules)
      if (rule.can.empty()) lines += lines_of(rule, rule.*statements);
    out += chain(name, std::string(name) + " priority filter; policy accept;", lines);
  }
  return out + "}\n";
}

MachineSetting setting(const fs::path& file, std::string text) {
  return {
      .file = file, .text = std::move(text), .then = fmt::format("sudo nft -f /{}", file.string())};
}

/// The bus of one place, as its rt.toml names it.
BusEndpoint endpoint_of(const fs::path& place) {
  const fs::path content = find_content(place).folder;
  const fs::path file = content / "rt.toml";
  TomlSource source(display_name(file), read_regular_file(file, kMostCellBytes), "E-RT");
  const toml::table parsed = source.parse();
  TomlTable top(parsed, "", source);
  const RtConfig config = read_rt_config(top, content);
  source.stop_on_errors();
  return config.source->endpoint();
}

ShortRun nft(std::vector<std::string> words) {
  words.insert(words.begin(), kNft);
  static const std::atomic<bool> never = false;
  return run_to_end({.words = std::move(words), .folder = "/"}, std::chrono::seconds(10), never);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// True if every statement of the rule is listed, by its comment.
bool is_listed(const FirewallRule& rule, const std::string& listed) {
  for (const auto& [name, statements] : kChains)
    for (const std::string& one : rule.*statements)
      if (listed.find(one.substr(one.find("comment "))) == std::string::npos) return false;
  return true;
}

/// The list without the tables that the kernel keeps and does not apply.
std::string without_dormant(const std::string& listed) {
  std::string out, table;
  bool dormant = false;
  std::istringstream lines(listed);
  for (std::string line; std::getline(lines, line);) {
    table += line + "\n";
    dormant = dormant || (line.starts_with("\tflags ") && line.find("dormant") != line.npos);
    if (line != "}") continue;
    out += dormant ? "" : table;
    table.clear();
    dormant = false;
  }
  return out + table;
}

Finding finding_of(const FirewallRule& rule, const FirewallInForce& now) {
  if (!now.listed) return {.why = now.why_not, .remedy = now.remedy};
  if (is_listed(rule, without_dormant(*now.listed)))
    return {.grant = Grant::kGranted, .why = rule.says};
  const bool dormant = is_listed(rule, *now.listed);
  return {.grant = Grant::kDenied,
          .why = rule.without + (dormant ? "; the table of its rule is dormant" : ""),
          .remedy = "sudo plumb-rt doctor --fix"};
}

Check check_of(const FirewallRule& rule, const FirewallInForce& now) {
  Check out{.id = "firewall", .finding = finding_of(rule, now)};
  out.finding.what = "firewall";
  return out;
}

Check not_asked(const std::string& why, const std::string& remedy) {
  return {.id = "firewall", .finding = {.what = "firewall", .why = why, .remedy = remedy}};
}

}  // namespace

FirewallRules firewall_rules(const fs::path& store) {
  FirewallRules out;
  std::error_code error;
  std::vector<fs::path> places;
  for (fs::directory_iterator at(store, error), end; !error && at != end; at.increment(error))
    if (is_place_name(at->path().filename().string()) && is_place(at->path()))
      places.push_back(at->path());
  if (error && error != std::errc::no_such_file_or_directory)
    out.unread.push_back(fmt::format("{}: {}", store.string(), error.message()));
  std::sort(places.begin(), places.end());
  for (const fs::path& place : places) {
    const std::string name = place.filename().string();
    try {
      if (auto rule = firewall_rule(name, endpoint_of(place), kServiceUser))
        out.rules.push_back(std::move(*rule));
    } catch (const Failure& failure) {
      out.unread.push_back(fmt::format("{}: {}", name, failure.problems().front().message));
    }
  }
  return out;
}

std::vector<MachineSetting> firewall_settings(const std::vector<FirewallRule>& rules) {
  std::map<fs::path, std::string> texts;
  for (const FirewallRule& rule : rules)
    texts.emplace(rule.file, rule.can.empty() ? tcp_text(rules) : can_text(rule));
  std::vector<MachineSetting> out;
  for (auto& [file, text] : texts) out.push_back(setting(file, std::move(text)));
  return out;
}

bool can_load_firewall() { return ::access(kNft, X_OK) == 0; }

FirewallInForce read_firewall() {
  if (!can_load_firewall())
    return {.why_not = "nft is not installed: every user of this machine may use the buses",
            .remedy = "sudo apt-get install nftables, then: sudo plumb-rt doctor --fix"};
  try {
    ShortRun ran = nft({"list", "ruleset"});
    if (ran.exit_code == 0) return {.listed = std::move(ran.out)};
    return {.why_not = "not known whether a rule is in force: " + first_line(ran.err),
            .remedy = kAskRoot};
  } catch (const std::system_error& error) {
    return {.why_not = fmt::format("not known whether a rule is in force: {}", error.what()),
            .remedy = kAskRoot};
  }
}

std::optional<std::string> load_firewall(const fs::path& file) {
  try {
    const ShortRun ran = nft({"-f", file.string()});
    if (ran.exit_code == 0) return std::nullopt;
    return first_line(ran.err);
  } catch (const std::system_error& error) {
    return error.what();
  }
}

std::vector<Check> firewall_checks(const FirewallRules& found, const FirewallInForce& now) {
  std::vector<Check> out;
  for (const FirewallRule& rule : found.rules) out.push_back(check_of(rule, now));
  for (const std::string& one : found.unread) out.push_back(not_asked(one, kAskRoot));
  if (out.empty())
    out.push_back(not_asked("no installed place has a bus to keep for plumb-rt", ""));
  return out;
}

}  // namespace plumb::drivers::rt
