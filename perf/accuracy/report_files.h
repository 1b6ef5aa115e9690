// Files of the report page, which the build embeds. The content of report/.
#pragma once

#include <string_view>

namespace tessera::accuracy {

extern const std::string_view kReportPage;
extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;
extern const std::string_view kD3Script;
extern const std::string_view kPlotScript;

}  // namespace tessera::accuracy
