#include "core/pipeline/report_page/html.h"

#include <gtest/gtest.h>

#include "core/base/result.h"

namespace farhorizon {
namespace {

TEST(Html, EscapesWhatHasAMeaning) {
  EXPECT_EQ(Html::Text("a<b> & \"c\" 'd'").markup(), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  EXPECT_EQ(Html::Text("</style><script>alert(1)</script>").markup(),
            "&lt;/style&gt;&lt;script&gt;alert(1)&lt;/script&gt;");
  EXPECT_EQ(Html::Text("Z\xC3\xBCrich \xE2\x82\xAC \xF0\x9F\x8F\x94\n").markup(),
            "Z\xC3\xBCrich \xE2\x82\xAC \xF0\x9F\x8F\x94\n");
}

TEST(Html, ReplacesWhatIsNoCharacter) {
  const std::string one = "\xEF\xBF\xBD";
  EXPECT_EQ(Html::Text(std::string_view("\0\x1B\x7F", 3)).markup(), one + one + one);
  EXPECT_EQ(Html::Text("\xFF<").markup(), one + "&lt;");
  // Cut short, longer than needed ("<" in two bytes), a surrogate, beyond U+10FFFF.
  EXPECT_EQ(Html::Text("\xE2\x82").markup(), one + one);
  EXPECT_EQ(Html::Text("\xC0\xBC").markup(), one + one);
  EXPECT_EQ(Html::Text("\xE0\x80\xBC").markup(), one + one + one);
  EXPECT_EQ(Html::Text("\xED\xA0\x80").markup(), one + one + one);
  EXPECT_EQ(Html::Text("\xF4\x90\x80\x80").markup(), one + one + one + one);
  // A control of two bytes, and one that turns the text after it around.
  EXPECT_EQ(Html::Text("\xC2\x85").markup(), one + one);
  EXPECT_EQ(Html::Text("\xE2\x80\xAE").markup(), one + one + one);
}

TEST(Element, HasClassesOnlyWhereThereAreSome) {
  EXPECT_EQ(Element("td", Html::Text("1 < 2")).markup(), "<td>1 &lt; 2</td>");
  EXPECT_EQ(Element("td", "x"_html, "number").markup(), "<td class=\"number\">x</td>");
}

TEST(FillTemplate, ReplacesEachNameOnce) {
  EXPECT_EQ(FillTemplate("a {{x}} b {{y}}{{x}}", {{"x", "{{y}}"_html}, {"y", "2"_html}}),
            "a {{y}} b 2{{y}}");
  EXPECT_EQ(FillTemplate("", {}), "");
  EXPECT_THROW(FillTemplate("{{z}}", {{"x", "1"_html}}), InternalError);
  EXPECT_THROW(FillTemplate("{{x", {{"x", "1"_html}}), InternalError);
}

}  // namespace
}  // namespace farhorizon
