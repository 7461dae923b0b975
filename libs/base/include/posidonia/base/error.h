#pragma once

#include <stdexcept>
#include <string>

namespace posidonia
{
/** What a user is told: where (file and place), what is wrong, and the way out.
 * The apps print what() on stderr and exit with status 1. */
class CError : public std::runtime_error
{
   public:
	using std::runtime_error::runtime_error;

	/** "<where>: <problem>; <way out>" */
	CError(const std::string& where, const std::string& problem, const std::string& way_out)
		: std::runtime_error(where + ": " + problem + (way_out.empty() ? "" : "; " + way_out))
	{
	}
};

/** A wrong command line: exit status 2. */
class CUsageError : public CError
{
   public:
	using CError::CError;
};
}  // namespace posidonia
