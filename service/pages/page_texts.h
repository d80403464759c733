#pragma once

#include <string_view>

namespace farhorizon {

/// The files of this folder that the pages consist of; the build puts their bytes into the program.
/// The .html are templates for FillTemplate.
extern const std::string_view kIndexHtml;
/// Of both pages, first.
extern const std::string_view kKeyJs;
/// Of the page at "/", in the order in which it runs them.
extern const std::string_view kUploadJs;
extern const std::string_view kIndexJs;
/// Of the page in the place of a viewer of no job.
extern const std::string_view kNoJobHtml;
/// Of the viewer, in the order in which a page runs them.
extern const std::string_view kViewerHtml;
extern const std::string_view kNumbersJs;
extern const std::string_view kHorizonLinesJs;
extern const std::string_view kSkylineJs;
extern const std::string_view kSceneJs;
extern const std::string_view kViewerJs;
extern const std::string_view kPalettesCss;
extern const std::string_view kIndexCss;
extern const std::string_view kViewerCss;

}  // namespace farhorizon
