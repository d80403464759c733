#include "core/pipeline/report_page/bar_table.h"

#include <algorithm>

#include "core/io/geojson_text.h"

namespace farhorizon {

namespace {

// `share` of a bar's whole length.
Html Bar(double share) {
  return Html::Markup(
      "<td class=\"bar\"><svg viewBox=\"0 0 100 10\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\"><rect width=\"" +
      Rounded(100 * share, 2) + "\" height=\"10\"/></svg></td>");
}

}  // namespace

Html DrawBars(const BarTable& table) {
  double greatest = 0;
  for (const BarTable::Row& row : table.rows) greatest = std::max(greatest, row.value);
  Html html = "<table class=\"bars\">"_html + Element("caption", table.caption) +
              "<thead><tr><th scope=\"col\">"_html + table.heads[0] +
              "</th><th scope=\"col\" class=\"number\">"_html + table.heads[1] +
              "</th><td></td><th scope=\"col\" class=\"number\">"_html + table.heads[2] +
              "</th></tr></thead><tbody>"_html;
  for (const BarTable::Row& row : table.rows) {
    html += "<tr><th scope=\"row\">"_html + row.name + "</th>"_html +
            Element("td", row.cells[0], "number") + Bar(greatest > 0 ? row.value / greatest : 0) +
            Element("td", row.cells[1], "number") + "</tr>"_html;
  }
  return html + "</tbody></table>"_html;
}

}  // namespace farhorizon
