#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <posidonia/base/options.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace posidonia
{
/** An ini file read strictly: an unknown key or section, a number that does not parse or is out of range is a
 * CError that names file, section and key. MRPT's `@define`, `${NAME}` and `$eval{...}` work.
 *
 *   CIniFile ini = CIniFile::fromFile("paper-exp1.ini");
 *   ini.set("Simulation.seed=11");
 *   const auto roi = ini.load<TRoiOptions>("EdgeRegistrationDecider");
 *   ini.refuseUnknown();
 */
class CIniFile
{
   public:
	static CIniFile fromFile(const std::string& path);
	static CIniFile fromText(const std::string& text, const std::string& name = "<text>");

	/** `Section.key=value`, as given to --set; wins over the file. Throws CUsageError on another shape. */
	void set(const std::string& section_dot_key_equals_value);

	/** Defaults of OPTIONS overridden by the keys of `section`; the section may be absent.
	 * Several structs may share one section. */
	template <class OPTIONS>
	OPTIONS load(const std::string& section)
	{
		OPTIONS options;
		loadOnto(options, section);
		return options;
	}

	/** As load(), over the present values of `options` instead of the defaults. */
	template <class OPTIONS>
	void loadOnto(OPTIONS& options, const std::string& section)
	{
		CReader reader(*this, section);
		options.visit(reader);
		remember(section, listOptions(options));
	}

	/** Names of the file's sections, in no particular order. */
	std::vector<std::string> sections() const;

	/** Throws for the first key or section that no load() asked for. Call it after all loads. */
	void refuseUnknown() const;

	/** The configuration as used: every loaded section with every key, its value, range and meaning. */
	std::string dump() const;

	const std::string& name() const { return m_name; }

   private:
	/** Visitor that fills an options struct from one section. */
	class CReader
	{
	   public:
		CReader(CIniFile& file, const std::string& section) : m_file(file), m_section(section) {}

		void number(const char* key, double& value, const TRange& range, const char* text);
		void degrees(const char* key, double& radians, const TRange& range_deg, const char* text);
		void integer(const char* key, int& value, const TRange& range, const char* text);
		void seed(const char* key, unsigned& value, const char* text);
		void flag(const char* key, bool& value, const char* text);
		void text(const char* key, std::string& value, const char* text);
		void choice(
			const char* key, std::string& value, const std::vector<std::string>& names, const char* text);
		void numbers(
			const char* key, std::vector<double>& values, size_t n, const TRange& range, const char* text);

	   private:
		bool find(const char* key, std::string& raw);
		double parse(const char* key, const std::string& raw, const TRange& range) const;
		[[noreturn]] void fail(const char* key, const std::string& raw, const std::string& problem) const;

		CIniFile& m_file;
		std::string m_section;
	};

	void remember(const std::string& section, const std::vector<TOptionDoc>& rows);

	std::string m_name;
	mrpt::config::CConfigFileMemory m_config;
	std::vector<std::string> m_section_order;
	std::map<std::string, std::vector<TOptionDoc>> m_known;
};
}  // namespace posidonia
