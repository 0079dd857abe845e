// SPDX-License-Identifier: Apache-2.0
#include "import/unit_words.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "cell/units.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string without_brackets(std::string text) {
  std::erase_if(text,
                [](char c) { return c == '[' || c == ']' || c == '(' || c == ')' || c == ' '; });
  return text;
}

}  // namespace

std::string known_unit(std::string text) {
  text = without_brackets(std::move(text));
  static const std::map<std::string, std::string> kOther{
      {"°", "deg"},     {"º", "deg"},   {"˚", "deg"},       {"grad", "deg"}, {"°c", "degC"},
      {"degc", "degC"}, {"℃", "degC"},  {"c", "degC"},      {"µm", "um"},    {"μm", "um"},
      {"\"", "in"},     {"毫米", "mm"}, {"度", "deg"},      {"弧度", "rad"}, {"ミリ", "mm"},
      {"米", "m"},      {"秒", "s"},    {"摄氏度", "degC"}, {"微米", "um"},  {"公斤", "kg"},
      {"千克", "kg"},   {"毫秒", "ms"}};
  static const std::map<std::string, std::string> kWords{{"degree", "deg"},
                                                         {"degrees", "deg"},
                                                         {"degre", "deg"},
                                                         {"degres", "deg"},
                                                         {"gradi", "deg"},
                                                         {"grados", "deg"},
                                                         {"celsius", "degC"},
                                                         {"gradcelsius", "degC"},
                                                         {"millimeter", "mm"},
                                                         {"millimetre", "mm"},
                                                         {"millimeters", "mm"},
                                                         {"millimetres", "mm"},
                                                         {"millimetri", "mm"},
                                                         {"milimetros", "mm"},
                                                         {"meter", "m"},
                                                         {"metre", "m"},
                                                         {"meters", "m"},
                                                         {"metres", "m"},
                                                         {"metri", "m"},
                                                         {"metros", "m"},
                                                         {"micron", "um"},
                                                         {"microns", "um"},
                                                         {"mikrometer", "um"},
                                                         {"micrometer", "um"},
                                                         {"micrometers", "um"},
                                                         {"micrometre", "um"},
                                                         {"mikron", "um"},
                                                         {"inch", "in"},
                                                         {"inches", "in"},
                                                         {"zoll", "in"},
                                                         {"pouce", "in"},
                                                         {"pollici", "in"},
                                                         {"radian", "rad"},
                                                         {"radians", "rad"},
                                                         {"radiant", "rad"},
                                                         {"radiants", "rad"},
                                                         {"radianti", "rad"},
                                                         {"radianes", "rad"},
                                                         {"sec", "s"},
                                                         {"secs", "s"},
                                                         {"second", "s"},
                                                         {"seconds", "s"},
                                                         {"sekunde", "s"},
                                                         {"sekunden", "s"},
                                                         {"msec", "ms"},
                                                         {"milliseconds", "ms"},
                                                         {"millisekunden", "ms"},
                                                         {"kilogram", "kg"},
                                                         {"kilogramm", "kg"},
                                                         {"kilogramme", "kg"},
                                                         {"gramm", "g"},
                                                         {"gram", "g"},
                                                         {"kelvin", "K"},
                                                         {"newton", "N"},
                                                         {"kg", "kg"},
                                                         {"k", "K"},
                                                         {"n", "N"},
                                                         {"nm", "Nm"}};
  if (unit_of(text)) return text;
  std::string small = lower(text);
  if (unit_of(small)) return small;
  if (const auto found = kOther.find(small); found != kOther.end()) return found->second;
  const auto found = kWords.find(folded(text));
  return found == kWords.end() ? std::string() : found->second;
}

std::string unit_of_others(std::string text) {
  text = without_brackets(std::move(text));
  for (const auto& tried : {text, lower(text)})
    if (foreign_unit(tried) != nullptr) return tried;
  return {};
}

}  // namespace plumb::offline
