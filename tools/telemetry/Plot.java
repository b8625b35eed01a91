package saker.telemetry;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.event.ActionEvent;
import java.io.IOException;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JFrame;
import javax.swing.JPanel;
import javax.swing.Timer;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;
import lcm.spy.ChannelData;

/**
 * A window of lcm-spy that draws what one robot says: a right click on a channel that it handles opens it. lcm-spy looks for classes that
 * name SpyPlugin themselves, so each plot does.
 */
abstract class Plot {
  private static final int REPAINT_MS = 200;

  private final String name;
  private final long fingerprint;

  Plot(String name, long fingerprint) {
    this.name = name;
    this.fingerprint = fingerprint;
  }

  /** What is drawn of one robot; `hear` and `draw` never run at the same time. */
  interface Picture {
    void hear(String channel, LCMDataInputStream message) throws IOException;

    void draw(Graphics2D g, Dimension size);
  }

  abstract Picture picture(String robot);

  /** Of the channels that the picture is made of, without the robot. */
  abstract String[] channels();

  public boolean canHandle(long found) {
    return found == fingerprint;
  }

  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction(name) {  // lcm-spy asks for its name without a channel
      @Override
      public void actionPerformed(ActionEvent event) {
        open(channel.name.substring(0, channel.name.indexOf('_')));
      }
    };
  }

  private void open(String robot) {
    Picture picture = picture(robot);
    LCMSubscriber subscriber = (lcm, channel, message) -> {
      synchronized (picture) {
        try {
          picture.hear(channel.substring(robot.length()), message);
        } catch (IOException cut) {
          // counted by lcm-spy itself as undecodable
        }
      }
    };
    for (String channel : channels()) LCM.getSingleton().subscribe(robot + channel, subscriber);
    JPanel panel = new JPanel() {
      @Override
      protected void paintComponent(Graphics graphics) {
        Graphics2D g = (Graphics2D) graphics;
        g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        g.setColor(Color.WHITE);
        g.fillRect(0, 0, getWidth(), getHeight());
        synchronized (picture) {
          picture.draw(g, getSize());
        }
      }
    };
    panel.setPreferredSize(new Dimension(640, 480));
    Timer timer = new Timer(REPAINT_MS, tick -> panel.repaint());
    JFrame frame = new JFrame(name + " of " + robot) {
      @Override
      public void dispose() {
        timer.stop();
        for (String channel : channels()) LCM.getSingleton().unsubscribe(robot + channel, subscriber);
        super.dispose();
      }
    };
    frame.setDefaultCloseOperation(JFrame.DISPOSE_ON_CLOSE);
    frame.add(panel);
    frame.pack();
    frame.setVisible(true);
    timer.start();
  }
}
