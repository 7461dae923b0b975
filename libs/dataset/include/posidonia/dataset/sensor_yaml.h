#pragma once

#include <Eigen/Dense>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace posidonia
{
/** An EuRoC sensor.yaml, or body.yaml: `key: value`, `key: [numbers]` over any lines, and one level of
 * nesting
 * (`T_BS:` with rows, cols, data). OpenCV's "%YAML:1.0" first line is accepted, which YAML proper is not.
 * Whatever is asked for and is not there, or is of another kind, is a CError that names file and line. */
class CSensorYaml
{
   public:
	/** Throws CError when the file does not exist or a line is not understood. */
	explicit CSensorYaml(const std::string& path);

	bool has(const std::string& key) const { return find(key) != nullptr; }
	std::string text(const std::string& key) const;
	double number(const std::string& key) const;
	/** Exactly `n` numbers. */
	std::vector<double> numbers(const std::string& key, size_t n) const;
	/** A 4x4 rigid transformation, row-major: `key: [16 numbers]` or `key:` with `data: [16 numbers]`. */
	Eigen::Isometry3d pose(const std::string& key) const;
	/** "<path>:<line>" of a key. */
	std::string where(const std::string& key) const;
	/** One message for each top-level key that is not among `known`: it has no effect. */
	std::vector<std::string> unknownKeys(const std::vector<std::string>& known) const;
	const std::string& path() const { return m_path; }

   private:
	struct TValue
	{
		std::string text;
		size_t line{0};
	};
	const TValue* find(const std::string& key) const;
	const TValue& at(const std::string& key) const;
	void parse(const std::string& text);
	void insert(const std::string& key, const TValue& value);

	std::string m_path;
	std::map<std::string, TValue> m_values;	 ///< Nested keys as "T_BS.data"
};
}  // namespace posidonia
