# Writes a source that names the commit, or nothing where there is no repository:
# cmake -DSOURCE=... -DOUTPUT=... -P write_commit.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=10 --exclude=* OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [=[
#include "@SOURCE@/apps/trivalent/commit.h"

namespace trivalent::apps {

const std::string_view commit = "@commit@";

}  // namespace trivalent::apps
]=])
