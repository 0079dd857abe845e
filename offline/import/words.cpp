// SPDX-License-Identifier: Apache-2.0
#include "import/words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

namespace plumb::offline {
namespace {

enum class Kind {
  kJoint,       // the number beside it counts joints
  kQ,           // a joint with a number, a quaternion with a letter
  kCommanded,   // of a joint: where it should be; of a point: nominal
  kTarget,      // of a joint: where it should be
  kMeasured,    // of a point
  kFiller,      // adds nothing: "actual", "value"
  kSigma,       // one standard deviation of a point
  kUncertain,   // an unknown multiple of a standard deviation
  kTurn,        // a rotation about an axis
  kQuaternion,  // a part of a quaternion
  kLabel,       // the name of a pose; beside x, y or z it adds nothing
  kName,        // means the column `Word::name`
  kAxis,        // x, y, z, w
  kNumber
};

struct Word {
  std::string_view text;  // as `folded` returns it
  Kind kind;
  std::string_view name = {};  // of kName
};

/// The one table of words. Single letters count only at the beginning of a name.
constexpr auto kWords = std::to_array<Word>({
    // Joints.
    {"q", Kind::kQ},
    {"j", Kind::kJoint},
    {"a", Kind::kJoint},
    {"actualq", Kind::kJoint},
    {"qc", Kind::kCommanded},
    {"qcmd", Kind::kCommanded},
    {"cmdq", Kind::kCommanded},
    {"targetq", Kind::kCommanded},
    {"joint", Kind::kJoint},
    {"axis", Kind::kJoint},
    {"theta", Kind::kJoint},
    {"achse", Kind::kJoint},
    {"gelenk", Kind::kJoint},
    {"gelenkwinkel", Kind::kJoint},
    {"achswinkel", Kind::kJoint},
    {"axe", Kind::kJoint},
    {"articulation", Kind::kJoint},
    {"asse", Kind::kJoint},
    {"giunto", Kind::kJoint},
    {"eje", Kind::kJoint},
    {"articulacion", Kind::kJoint},
    {"轴", Kind::kJoint},
    {"軸", Kind::kJoint},
    {"关节", Kind::kJoint},
    {"關節", Kind::kJoint},
    {"関節", Kind::kJoint},
    // Where something should be.
    {"cmd", Kind::kCommanded},
    {"commanded", Kind::kCommanded},
    {"target", Kind::kTarget},
    {"n", Kind::kCommanded},
    {"nom", Kind::kCommanded},
    {"nominal", Kind::kCommanded},
    {"soll", Kind::kCommanded},
    {"sollwert", Kind::kCommanded},
    {"nominale", Kind::kCommanded},
    {"theorique", Kind::kCommanded},
    {"teorico", Kind::kCommanded},
    // Where a point is.
    {"m", Kind::kMeasured},
    {"meas", Kind::kMeasured},
    {"measured", Kind::kMeasured},
    {"measurement", Kind::kMeasured},
    {"tracker", Kind::kMeasured},
    {"coord", Kind::kMeasured},
    {"coordinate", Kind::kMeasured},
    {"koordinate", Kind::kMeasured},
    {"gemessen", Kind::kMeasured},
    {"messwert", Kind::kMeasured},
    {"coordonnee", Kind::kMeasured},
    {"mesure", Kind::kMeasured},
    {"mesuree", Kind::kMeasured},
    {"coordinata", Kind::kMeasured},
    {"misura", Kind::kMeasured},
    {"misurata", Kind::kMeasured},
    {"coordenada", Kind::kMeasured},
    {"medida", Kind::kMeasured},
    {"坐标", Kind::kMeasured},
    {"坐標", Kind::kMeasured},
    {"座標", Kind::kMeasured},
    {"测量", Kind::kMeasured},
    {"測定", Kind::kMeasured},
    // Words that add nothing.
    {"pos", Kind::kFiller},
    {"position", Kind::kFiller},
    {"posizione", Kind::kFiller},
    {"posicion", Kind::kFiller},
    {"actual", Kind::kFiller},
    {"act", Kind::kFiller},
    {"ist", Kind::kFiller},
    {"istwert", Kind::kFiller},
    {"value", Kind::kFiller},
    {"wert", Kind::kFiller},
    {"angle", Kind::kFiller},
    {"winkel", Kind::kFiller},
    {"angolo", Kind::kFiller},
    {"angulo", Kind::kFiller},
    {"第", Kind::kFiller},
    {"角度", Kind::kFiller},
    {"位置", Kind::kFiller},
    {"值", Kind::kFiller},
    // How well a point is known.
    {"s", Kind::kSigma},
    {"sigma", Kind::kSigma},
    {"std", Kind::kSigma},
    {"stdev", Kind::kSigma},
    {"stddev", Kind::kSigma},
    {"standarddeviation", Kind::kSigma},
    {"standardabweichung", Kind::kSigma},
    {"standardunsicherheit", Kind::kSigma},
    {"standarduncertainty", Kind::kSigma},
    {"ecarttype", Kind::kSigma},
    {"deviazionestandard", Kind::kSigma},
    {"scartotipo", Kind::kSigma},
    {"desviacionestandar", Kind::kSigma},
    {"标准差", Kind::kSigma},
    {"標準偏差", Kind::kSigma},
    {"u", Kind::kUncertain},
    {"uncertainty", Kind::kUncertain},
    {"unsicherheit", Kind::kUncertain},
    {"messunsicherheit", Kind::kUncertain},
    {"incertitude", Kind::kUncertain},
    {"incertezza", Kind::kUncertain},
    {"incertidumbre", Kind::kUncertain},
    {"不确定度", Kind::kUncertain},
    {"不確かさ", Kind::kUncertain},
    // Orientations.
    {"r", Kind::kTurn},
    {"quat", Kind::kQuaternion},
    {"quaternion", Kind::kQuaternion},
    {"orientation", Kind::kQuaternion},
    // Poses.
    {"point", Kind::kLabel},
    {"pointname", Kind::kLabel},
    {"punkt", Kind::kLabel},
    {"punktname", Kind::kLabel},
    {"messpunkt", Kind::kLabel},
    {"nomdupoint", Kind::kLabel},
    {"punto", Kind::kLabel},
    {"nomepunto", Kind::kLabel},
    {"nombredelpunto", Kind::kLabel},
    {"点", Kind::kLabel},
    {"点名", Kind::kLabel},
    {"點名", Kind::kLabel},
    {"name", Kind::kName, "pose"},
    {"id", Kind::kName, "pose"},
    {"pose", Kind::kLabel},
    {"poseid", Kind::kName, "pose"},
    {"posename", Kind::kName, "pose"},
    // Load and temperature.
    {"payload", Kind::kName, "payload"},
    {"load", Kind::kName, "payload"},
    {"last", Kind::kName, "payload"},
    {"traglast", Kind::kName, "payload"},
    {"nutzlast", Kind::kName, "payload"},
    {"zuladung", Kind::kName, "payload"},
    {"charge", Kind::kName, "payload"},
    {"chargeutile", Kind::kName, "payload"},
    {"carico", Kind::kName, "payload"},
    {"carga", Kind::kName, "payload"},
    {"cargautil", Kind::kName, "payload"},
    {"负载", Kind::kName, "payload"},
    {"負載", Kind::kName, "payload"},
    {"負荷", Kind::kName, "payload"},
    {"temp", Kind::kName, "temp"},
    {"temperature", Kind::kName, "temp"},
    {"temperatur", Kind::kName, "temp"},
    {"temperatura", Kind::kName, "temp"},
    {"温度", Kind::kName, "temp"},
    {"溫度", Kind::kName, "temp"},
    // Times.
    {"t", Kind::kName, "t"},
    {"time", Kind::kName, "time"},
    {"timestamp", Kind::kName, "time"},
    {"datetime", Kind::kName, "time"},
    {"zeit", Kind::kName, "time"},
    {"uhrzeit", Kind::kName, "time"},
    {"zeitstempel", Kind::kName, "time"},
    {"temps", Kind::kName, "time"},
    {"heure", Kind::kName, "time"},
    {"horodatage", Kind::kName, "time"},
    {"tempo", Kind::kName, "time"},
    {"ora", Kind::kName, "time"},
    {"orario", Kind::kName, "time"},
    {"tiempo", Kind::kName, "time"},
    {"hora", Kind::kName, "time"},
    {"时间", Kind::kName, "time"},
    {"时间戳", Kind::kName, "time"},
    {"時間", Kind::kName, "time"},
    {"時刻", Kind::kName, "time"},
    {"日時", Kind::kName, "time"},
    {"date", Kind::kName, "date"},
    {"datum", Kind::kName, "date"},
    {"fecha", Kind::kName, "date"},
    {"日期", Kind::kName, "date"},
    {"日付", Kind::kName, "date"},
    // The rest.
    {"set", Kind::kName, "set"},
    {"setup", Kind::kName, "setup"},
    {"repeat", Kind::kName, "repeat"},
    {"note", Kind::kName, "note"},
    {"comment", Kind::kName, "note"},
    {"remark", Kind::kName, "note"},
    {"bemerkung", Kind::kName, "note"},
    {"kommentar", Kind::kName, "note"},
    {"anmerkung", Kind::kName, "note"},
    {"remarque", Kind::kName, "note"},
    {"commentaire", Kind::kName, "note"},
    {"nota", Kind::kName, "note"},
    {"commento", Kind::kName, "note"},
    {"observacion", Kind::kName, "note"},
    {"comentario", Kind::kName, "note"},
    {"备注", Kind::kName, "note"},
    {"備考", Kind::kName, "note"},
});

struct Token {
  Kind kind;
  std::string_view text;
  std::string_view name;
};

/// Letters with accents of Latin-1 and Latin Extended-A, in the order of their code points.
std::string_view plain_letter(unsigned code) {
  static constexpr std::string_view kLatin1[] = {
      "a", "a", "a", "a", "a", "a", "ae", "c", "e", "e", "e", "e", "i", "i", "i", "i",
      "d", "n", "o", "o", "o", "o", "o",  "",  "o", "u", "u", "u", "u", "y", "th"};
  if (code == 0xDF) return "ss";
  if (code == 0xFF) return "y";
  if (code >= 0xC0 && code <= 0xDE) return kLatin1[code - 0xC0];
  if (code >= 0xE0 && code <= 0xFE) return kLatin1[code - 0xE0];
  if (code == 0xB5 || code == 0x3BC) return "u";
  if (code == 0x3C3 || code == 0x3A3) return "sigma";
  if (code == 0x3B8 || code == 0x398) return "theta";
  return {};
}

bool is_single_letter(const Word& word) { return word.text.size() == 1; }

/// The fewest words of which the text is made, or nothing.
std::optional<std::vector<Token>> tokens_of(std::string_view text) {
  std::vector<std::optional<std::vector<Token>>> best(text.size() + 1);
  best[0].emplace();
  const auto reach = [&](std::size_t from, std::size_t length, Kind kind, std::string_view name) {
    auto& to = best[from + length];
    if (to && to->size() <= best[from]->size() + 1) return;
    auto tokens = *best[from];
    tokens.push_back({kind, text.substr(from, length), name});
    to = std::move(tokens);
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!best[i]) continue;
    const auto rest = text.substr(i);
    for (const auto& word : kWords)
      if (rest.starts_with(word.text) && (i == 0 || !is_single_letter(word)))
        reach(i, word.text.size(), word.kind, word.name);
    std::size_t digits = 0;
    while (digits < rest.size() && std::isdigit(static_cast<unsigned char>(rest[digits]))) ++digits;
    if (digits > 0 && digits <= 2) reach(i, digits, Kind::kNumber, {});
    if (rest[0] == 'w' || (rest[0] >= 'x' && rest[0] <= 'z')) reach(i, 1, Kind::kAxis, {});
  }
  return best.back();
}

}  // namespace

std::string folded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80) {
      if (std::isalnum(byte)) out += static_cast<char>(std::tolower(byte));
      ++i;
      continue;
    }
    const std::size_t length = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
    const auto character = text.substr(i, length);
    i += length;
    if (length == 2 && character.size() == 2) {
      out += plain_letter((byte & 0x1FU) << 6 | (static_cast<unsigned char>(character[1]) & 0x3FU));
      continue;
    }
    // Signs of Chinese and Japanese, full-width brackets among them, are left out.
    if (character.starts_with("\xE3\x80") || character.starts_with("\xEF\xBC") ||
        character.starts_with("\xE2"))
      continue;
    out += character;
  }
  return out;
}

NamedColumn named_column(std::string_view header) {
  NamedColumn out;
  const std::string text = folded(header);
  const auto tokens = text.empty() ? std::nullopt : tokens_of(text);
  if (!tokens) return out;
  const auto count = [&](Kind kind) {
    return std::count_if(tokens->begin(), tokens->end(),
                         [&](const Token& t) { return t.kind == kind; });
  };
  const auto only = [&](std::initializer_list<Kind> kinds) {
    return std::all_of(tokens->begin(), tokens->end(), [&](const Token& t) {
      return std::find(kinds.begin(), kinds.end(), t.kind) != kinds.end();
    });
  };
  const auto find = [&](Kind kind) {
    return std::find_if(tokens->begin(), tokens->end(),
                        [&](const Token& t) { return t.kind == kind; });
  };
  if (count(Kind::kNumber) == 1 && count(Kind::kAxis) == 0) {
    out.number = std::stoi(std::string(find(Kind::kNumber)->text));
    for (const auto& t : *tokens)
      if (t.kind != Kind::kNumber) out.stem += t.text;
    if (count(Kind::kQuaternion) == 1 && only({Kind::kQuaternion, Kind::kFiller, Kind::kNumber})) {
      out.quaternion_part = true;
      return out;
    }
    if (!only({Kind::kJoint, Kind::kQ, Kind::kCommanded, Kind::kTarget, Kind::kFiller,
               Kind::kNumber}))
      return out;
    const bool commanded = count(Kind::kCommanded) + count(Kind::kTarget) > 0;
    const bool joint = count(Kind::kJoint) + count(Kind::kQ) > 0 ||
                       tokens->front().text.find('q') != std::string_view::npos;
    if (!joint) return out;
    out.letter_q = count(Kind::kQ) == 1 && tokens->size() == 2;
    out.name = (commanded ? "qc" : "q") + std::to_string(out.number);
    return out;
  }
  if (count(Kind::kAxis) == 1 && count(Kind::kNumber) == 0) {
    const std::string axis(find(Kind::kAxis)->text);
    if ((count(Kind::kQuaternion) == 1 &&
         only({Kind::kQuaternion, Kind::kFiller, Kind::kMeasured, Kind::kLabel, Kind::kAxis})) ||
        (count(Kind::kQ) == 1 && tokens->size() == 2)) {
      out.name = "q" + axis;
      return out;
    }
    if (axis == "w") return out;
    if (only({Kind::kAxis, Kind::kMeasured, Kind::kFiller, Kind::kLabel}))
      out.name = axis;
    else if (only({Kind::kAxis, Kind::kMeasured, Kind::kFiller, Kind::kLabel, Kind::kCommanded}))
      out.name = "n" + axis;
    else if (count(Kind::kSigma) > 0 &&
             only({Kind::kAxis, Kind::kMeasured, Kind::kFiller, Kind::kSigma, Kind::kUncertain}))
      out.name = "s" + axis;
    else if (only({Kind::kAxis, Kind::kMeasured, Kind::kFiller, Kind::kUncertain}))
      out.name = "s" + axis, out.uncertain = true;
    else if (only({Kind::kAxis, Kind::kMeasured, Kind::kTurn}) && count(Kind::kTurn) == 1)
      out.name = "r" + axis;
    return out;
  }
  if (count(Kind::kNumber) + count(Kind::kAxis) > 0) return out;
  if (count(Kind::kLabel) == 1 && tokens->size() == 1) out.name = "pose";
  if (count(Kind::kName) == 1 && only({Kind::kName, Kind::kFiller, Kind::kMeasured}))
    out.name = find(Kind::kName)->name;
  if (tokens->size() == 2 && tokens->front().kind == Kind::kLabel && tokens->back().name == "pose")
    out.name = "pose";
  if (count(Kind::kUncertain) == 1 && only({Kind::kUncertain, Kind::kFiller})) out.uncertain = true;
  return out;
}

}  // namespace plumb::offline
