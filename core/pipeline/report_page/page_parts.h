#pragma once

#include <string_view>

namespace farhorizon {

/// The page's parts that are files of this folder: page.html, a template for FillTemplate, page.css
/// and page.js. The build puts their bytes into the program.
extern const std::string_view kPageHtml;
extern const std::string_view kPageCss;
extern const std::string_view kPageJs;

}  // namespace farhorizon
