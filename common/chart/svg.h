// Elements of SVG as text. Coordinates are pixels from the top left.
#pragma once

#include <string>
#include <string_view>

namespace diptych::core::chart {

struct Point2 {
    double x = 0;
    double y = 0;
};

/// Text for the content or a quoted attribute of XML and HTML. Control characters and bytes that are not UTF-8, which
/// no XML may hold, become U+FFFD.
std::string xml_text(std::string_view text);

/// About how wide a text is: fonts differ, so it is that of a wide one.
double text_width(std::string_view text, double size);

std::string svg_line(Point2 from, Point2 to, std::string_view attributes);
/// "start", "middle" or "end" of the text stands at the point; `text` is escaped.
std::string svg_label(Point2 at, std::string_view anchor, std::string_view text, std::string_view attributes = "");

/// The line at the top of a document; smaller where the document's width needs it. Width 0: as wide as it gets.
std::string svg_title(std::string_view text, double document_width);

/// A PNG file as a URI that a page or an SVG can hold.
std::string png_uri(std::string_view png);

/// The whole document: `content` on white paper, `name` for readers that do not see it. The attributes say how it looks
/// in a file; a page that holds the SVG restyles it by the classes.
std::string svg_document(double width, double height, std::string_view name, std::string_view content);

}  // namespace diptych::core::chart
