#include "world_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
constexpr double kHeight = 2.5;
const Isometry3d kView = cameraAt(0, 0, kSeaFloor - kHeight);

double greyInTheMiddle(int texture, const TOptics& optics, double height = kHeight)
{
	const CFloorTexture plain = plainTexture(texture);
	const CFloorRenderer renderer(plain, std::make_shared<CFlatSeaFloor>(kSeaFloor), TStereoCamera(), optics);
	const cv::Mat picture = renderer.render(cameraAt(0, 0, kSeaFloor - height), 1);
	return meanOf(picture(cv::Rect(310, 230, 20, 20)));
}
TOptics murky(double attenuation, double backscatter, double veil)
{
	TOptics o = perfectOptics();
	o.water = {attenuation, backscatter, veil, "none"};
	return o;
}
TWaterOptions jerlov(const std::string& type)
{
	TWaterOptions o;
	o.jerlov = type;
	return o;
}
const std::vector<std::string> kTypes{"I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C", "9C"};
}  // namespace

TEST(Water, ContrastFallsExponentiallyWithTheAttenuationAlone)
{
	for (const double c : {0.1, 0.35, 0.6})
		for (const double height : {1.0, 2.5, 4.0}) {
			const TOptics optics = murky(c, 0.5, 60);
			const double contrast =
				greyInTheMiddle(220, optics, height) - greyInTheMiddle(60, optics, height);
			EXPECT_NEAR(contrast, 160 * std::exp(-c * height), 1.1) << "c " << c << " height " << height;
		}
}

TEST(Water, JerlovTypesKeepKirksRelationToTheirDaylight)
{
	// attenuation = a + b / 5 and backscatter = a + b must give back K_d^2 = a^2 + 0.256 a b of the table.
	const std::map<std::string, double> daylight{{"I", 0.053}, {"II", 0.082}, {"3C", 0.195}, {"9C", 0.705}};
	for (const auto& [type, K_d] : daylight) {
		const TWaterCoefficients c = coefficientsOf(jerlov(type));
		const double b = (c.backscatter - c.attenuation) / 0.8, a = c.backscatter - b;
		EXPECT_NEAR(std::sqrt(a * a + 0.256 * a * b), K_d, 1e-12) << type;
		EXPECT_GT(b / a, 0.3) << type;
		EXPECT_LT(b / a, 5) << type;
	}
}

TEST(Water, JerlovTypesAreALadder)
{
	TWaterCoefficients before{0, 0};
	for (const std::string& type : kTypes) {
		const TWaterCoefficients c = coefficientsOf(jerlov(type));
		EXPECT_GT(c.attenuation, before.attenuation) << type;
		EXPECT_GT(c.backscatter, before.backscatter) << type;
		EXPECT_GT(c.backscatter, c.attenuation) << type << ": different coefficients";
		before = c;
	}
	// At 2.5 m the coast is easy, 5C marginal, 9C blind (three grey levels of noise, contrast of 30).
	EXPECT_GT(std::exp(-2.5 * coefficientsOf(jerlov("1C")).attenuation), 0.7);
	EXPECT_NEAR(std::exp(-2.5 * coefficientsOf(jerlov("5C")).attenuation), 0.42, 0.05);
	EXPECT_LE(std::exp(-2.5 * coefficientsOf(jerlov("9C")).attenuation), 0.1);
}

TEST(Water, NoneKeepsTheExplicitCoefficientsAndATypeReplacesThem)
{
	TWaterOptions o{0.11, 0.22, 75, "none"};
	EXPECT_EQ(coefficientsOf(o).attenuation, 0.11);
	EXPECT_EQ(coefficientsOf(o).backscatter, 0.22);
	o.jerlov = "3C";
	EXPECT_EQ(coefficientsOf(o).attenuation, coefficientsOf(jerlov("3C")).attenuation);
	TOptics typed = perfectOptics(), spelled = perfectOptics();
	typed.water = jerlov("3C");
	const TWaterCoefficients c = coefficientsOf(typed.water);
	spelled.water = {c.attenuation, c.backscatter, 75, "none"};
	EXPECT_EQ(greyInTheMiddle(180, typed), greyInTheMiddle(180, spelled));
}

TEST(Water, TurbidityBurstMultipliesBothCoefficients)
{
	const auto floor = std::make_shared<CFlatSeaFloor>(kSeaFloor);
	const CFloorRenderer clear(rockTexture(), floor, TStereoCamera(), murky(0.1, 0.2, 75));
	const CFloorRenderer burst(rockTexture(), floor, TStereoCamera(), murky(0.3, 0.6, 75));
	CFloorRenderer::TConditions conditions;
	conditions.water_factor = 3;
	EXPECT_LE(cv::norm(clear.render({{kView}}, conditions, 1), burst.render(kView, 1), cv::NORM_INF), 1);
	conditions.water_factor = 1;
	EXPECT_EQ(cv::norm(clear.render({{kView}}, conditions, 1), clear.render(kView, 1), cv::NORM_INF), 0);
}

TEST(Lamp, LightFallsOffWithDistanceSquaredAngleAndBothWays)
{
	TOptics optics = murky(0.2, 0, 75);
	optics.lamp.kind = "point", optics.lamp.reference = 2;
	const TStereoCamera camera;
	const Vector3d lamp(0.4, -0.3, kSeaFloor - kHeight);
	const CFloorTexture plain = plainTexture(200);
	const CFloorRenderer renderer(
		plain, std::make_shared<CFlatSeaFloor>(kSeaFloor), camera, optics,
		(lamp - kView.translation()).norm());
	const cv::Mat picture = renderer.render({{kView, lamp}}, {}, 1);
	for (const cv::Point p :
		 {cv::Point(320, 240), cv::Point(30, 40), cv::Point(600, 100), cv::Point(200, 470)}) {
		const Vector3d ray = rayOf(camera, kView, p.x, p.y);
		const double range = kHeight / ray.z();
		const Vector3d point = kView.translation() + range * ray;
		const double distance = (lamp - point).norm(), cosine = kHeight / distance;
		const double grey = 200 * cosine * std::pow(2 / distance, 2) * std::exp(-0.2 * (range + distance));
		EXPECT_NEAR(picture.at<uint8_t>(p), grey, 1) << p;
	}
}

TEST(Lamp, ItsVeilIsMadeNearTheLampAndEndsAtTheVeilingLight)
{
	const TWaterOptions water{0.2, 0.2, 75, "none"};
	TLampOptions lamp;
	const CWaterTables even(water, lamp, 0.35, 1);
	lamp.kind = "point";
	const CWaterTables lit(water, lamp, 0.35, 1), wide(water, lamp, 1.0, 1);
	float before = 0;
	for (const float range : {0.2f, 0.5f, 1.0f, 2.5f, 5.0f, 40.0f}) {
		EXPECT_GT(lit.veil(range), before) << range;
		EXPECT_GE(lit.veil(range), even.veil(range)) << range;
		before = lit.veil(range);
	}
	EXPECT_NEAR(lit.veil(40), 75, 0.1f);
	EXPECT_LT(wide.veil(1), lit.veil(1)) << "a lamp farther from the camera veils less nearby";
}
