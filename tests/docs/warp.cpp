// Around the lines of the front page: they turn a picture of one colour in a square.
#include <icc/icc.hpp>

#include <array>
#include <vector>

int main()
{
    const std::vector<double> before{0, 0, 8, 0, 8, 8, 0, 8}, after{4, 0, 8, 4, 4, 8, 0, 4};
    std::array<unsigned char, 64> pixels, result{};
    pixels.fill(200);
    icc_picture picture = icc::sized<icc_picture>();
    picture.width = picture.height = 8;
    picture.channels = picture.bytes = 1;
    picture.stride = 8;
    icc_picture warped = picture;
    picture.pixels = pixels.data();
    warped.pixels = result.data();

    SNIPPET

    return result[4 * 8 + 4] != 200 || result[0] != 0;
}
