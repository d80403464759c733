#include "service/pages/pages.h"

#include <array>
#include <utility>

#include "core/io/sha256.h"
#include "core/pipeline/report_page/html.h"
#include "service/pages/page_texts.h"

namespace farhorizon {

namespace {

struct File {
  std::string_view name;
  const std::string_view& text;
};

constexpr std::array<File, 2> kViewerStyles = {
    {{"palettes.css", kPalettesCss}, {"viewer.css", kViewerCss}}};
constexpr std::array<File, 6> kViewerScripts = {{{"key.js", kKeyJs},
                                                 {"numbers.js", kNumbersJs},
                                                 {"horizon_lines.js", kHorizonLinesJs},
                                                 {"skyline.js", kSkylineJs},
                                                 {"scene.js", kSceneJs},
                                                 {"viewer.js", kViewerJs}}};
constexpr std::array<File, 11> kFiles = {{{"palettes.css", kPalettesCss},
                                          {"index.css", kIndexCss},
                                          {"key.js", kKeyJs},
                                          {"upload.js", kUploadJs},
                                          {"index.js", kIndexJs},
                                          {"viewer.css", kViewerCss},
                                          {"numbers.js", kNumbersJs},
                                          {"horizon_lines.js", kHorizonLinesJs},
                                          {"skyline.js", kSkylineJs},
                                          {"scene.js", kSceneJs},
                                          {"viewer.js", kViewerJs}}};

Html FilledViewer(const ViewerPlaces& places, Html styles, Html scripts) {
  return Html::Markup(FillTemplate(kViewerHtml, {{"styles", std::move(styles)},
                                                 {"scripts", std::move(scripts)},
                                                 {"results", Html::Text(places.results)},
                                                 {"cesium", Html::Text(places.cesium)},
                                                 {"home", Html::Text(places.home)}}));
}

}  // namespace

std::string IndexPage() {
  return FillTemplate(kIndexHtml, {{"assets", Html::Markup("assets/" + PageFingerprint())}});
}

std::string NoJobPage(const std::string& why) {
  return FillTemplate(kNoJobHtml, {{"assets", Html::Markup("assets/" + PageFingerprint())},
                                   {"why", Html::Text(why)}});
}

std::string ViewerPage(const ViewerPlaces& places) {
  const std::string folder = "../assets/" + PageFingerprint() + "/";
  std::string styles;
  for (const File& file : kViewerStyles) {
    styles += "<link rel=\"stylesheet\" href=\"" + folder + std::string(file.name) + "\">\n";
  }
  std::string scripts;
  for (const File& file : kViewerScripts) {
    scripts += "<script src=\"" + folder + std::string(file.name) + "\" defer></script>\n";
  }
  return FilledViewer(places, Html::Markup(std::move(styles)), Html::Markup(std::move(scripts)))
      .markup();
}

std::string StandaloneViewer(const ViewerPlaces& places) {
  std::string styles = "<style>\n";
  for (const File& file : kViewerStyles) styles += file.text;
  std::string scripts;
  for (const File& file : kViewerScripts) {
    scripts += "<script>\n" + std::string(file.text) + "</script>\n";
  }
  return FilledViewer(places, Html::Markup(styles + "</style>\n"), Html::Markup(std::move(scripts)))
      .markup();
}

std::string_view PageFile(std::string_view name) {
  for (const File& file : kFiles) {
    if (file.name == name) return file.text;
  }
  return {};
}

const std::string& PageFingerprint() {
  static const std::string fingerprint = [] {
    Sha256 all;
    for (const File& file : kFiles) all.Add(file.text);
    return all.Finish().Hex().substr(0, 16);
  }();
  return fingerprint;
}

}  // namespace farhorizon
